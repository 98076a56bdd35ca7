// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What must not hurt the service: peers that die, come back, send nonsense.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "tests/support/hostile_peer.hpp"
#include "tests/support/network.hpp"
#include "tests/support/process_state.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// How many relevant scans the map has, as the service says at its end.
int RelevantScans(const Outcome& served) {
  const std::size_t at = served.output.find(" points of ");
  return at == std::string::npos ? -1 : std::stoi(served.output.substr(at + 11));
}

class DdsFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string generator = ProgramPath().parent_path() / "generate_demo_log";
    const std::string command = generator + " two-rooms " + Log() + " 2>/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  std::string Log() const { return Path("two-rooms.log"); }
  std::string Path(const char* name) const { return folder_.path() / name; }
  std::vector<std::string> Serve(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"serve", "--verbose"});
    return network_.JoinService(more);
  }
  Outcome Replay(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"replay", Log(), "--robot", "robot1"});
    return network_.Run(more);
  }
  Outcome MapOf() const {
    return RunProgram({"map", Log(), "--output", Path("mapped"), "--set", "graph.enabled=false"});
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

/// The log of a drive in a room without its scans before that one.
std::filesystem::path LogFrom(const std::filesystem::path& log, int scan) {
  std::filesystem::path rest = log;
  rest.replace_extension(".rest.log");
  std::ifstream in(log);
  std::ofstream out(rest);
  int scans = 0;
  for (std::string line; std::getline(in, line);) {
    if (scans >= scan || line.starts_with('#') || line.starts_with("PARAM")) out << line << '\n';
    if (line.starts_with("FLASER")) ++scans;
  }
  return rest;
}

/// The position in the last line of a trajectory.
Eigen::Vector2d EndOf(const std::string& trajectory) {
  Eigen::Vector2d position_m(1e9, 1e9);
  const std::size_t line = trajectory.rfind('\n', trajectory.size() - 2);
  sscanf(trajectory.c_str() + line + 1, "%*f %lf %lf", &position_m.x(), &position_m.y());
  return position_m;
}

TEST_F(DdsFaults, RobotThatDiesIsLostAndComesBackWhereItLeft) {
  constexpr int kScans = 900;
  WriteRoomLog(Path("room.log"), kScans);
  Daemon service(Serve({"--output", Path("served")}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  {
    Daemon robot(network_.Join({"replay", Path("room.log"), "--robot", "robot1", "--rate", "20"}));
    ASSERT_TRUE(service.WaitUntilItSays("robot1: joined"));
    std::this_thread::sleep_for(1500ms);
    robot.End(SIGKILL);
  }
  // Nothing tells of the death but ten seconds of silence.
  ASSERT_TRUE(service.WaitUntilItSays("robot1: is lost") ||
              service.WaitUntilItSays("robot1: is lost"));
  const Outcome replay = network_.Run(
      {"replay", LogFrom(Path("room.log"), 600), "--robot", "robot1", "--rate", "max"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;
  EXPECT_NE(served.output.find(" 0 dead-reckoned"), std::string::npos) << served.output;

  const Pose2 T_start_end = PoseInRoom(0).Inverse() * PoseInRoom(kScans - 1);
  const Eigen::Vector2d end_m = EndOf(ReadFile(Path("served/robot1/trajectory.tum")));
  EXPECT_LT((end_m - T_start_end.translation_m()).norm(), 0.05) << served.output;
}

TEST_F(DdsFaults, LateServiceHasTheMapOfTheFirstOneWhichMayDie) {
  Daemon first(Serve({"--set", "team.service=first"}));
  ASSERT_TRUE(first.WaitUntilItSays("serving as"));
  ASSERT_EQ(Replay({"--rate", "max"}).exit_code, 0);

  Daemon second(Serve({"nobody", "--set", "team.service=second"}));
  ASSERT_TRUE(second.WaitUntilItSays("serving as"));
  std::this_thread::sleep_for(2s);  // Nothing tells that no more will come.
  const Outcome of_first = first.End(SIGTERM);
  const Outcome of_second = second.End(SIGTERM);
  EXPECT_GT(RelevantScans(of_first), 10);
  EXPECT_EQ(RelevantScans(of_second), RelevantScans(of_first)) << of_second.errors;
}

TEST_F(DdsFaults, GarbageOnThePortsChangesNothing) {
  Daemon service(Serve({"--output", Path("served")}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  SendGarbage(UdpPorts(service.process()), 20'000);
  const Outcome replay = Replay({"--rate", "max"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  EXPECT_LT(served.errors.size(), 100'000U) << "messages are not limited";
  ASSERT_EQ(MapOf().exit_code, 0);
  EXPECT_TRUE(ReadFile(Path("served/robot1/trajectory.tum")) ==
              ReadFile(Path("mapped/trajectory.tum")));
}

/// Publishes scans of the right type with contents no laser would give.
void PublishAbsurdScans(const PrivateNetwork& network) {
  const dds::Participant participant({.interface = "lo", .tag = network.tag()});
  const dds::Writer<dds::wire::LaserScan> scans(
      participant, "/robot1/scan", dds::Profile::kSensorOut);
  for (int i = 0; i < 500 && scans.reader_count() == 0; ++i) std::this_thread::sleep_for(10ms);
  ASSERT_GT(scans.reader_count(), 0U);
  const LaserScan good{.stamp = 1s,
                       .geometry = {.first_bearing_rad = -1.5F,
                                    .bearing_step_rad = 0.017F,
                                    .range_min_m = 0.0F,
                                    .range_max_m = 30.0F,
                                    .T_robot_laser = {}},
                       .ranges_m = std::vector<float>(181, 5.0F)};
  const std::string frame = "robot1/base_link";
  const std::string no_frame;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> many(200'000, 1.0F);
  for (int round = 0; round < 20; ++round) {
    dds::wire::LaserScan sample = dds::ToWire(good, frame);
    sample.header.stamp.nanosec = 4'000'000'000U;
    scans.Write(sample);
    scans.Write(dds::ToWire(good, no_frame));
    sample = dds::ToWire(good, frame);
    sample.angle_increment = nan;
    scans.Write(sample);
    sample = dds::ToWire(good, frame);
    sample.range_max = std::numeric_limits<float>::infinity();
    scans.Write(sample);
    sample.ranges._length = 0;
    scans.Write(sample);
    const auto count = static_cast<std::uint32_t>(many.size());
    sample = dds::ToWire(good, frame);
    sample.ranges = {
        ._maximum = count, ._length = count, ._buffer = many.data(), ._release = false};
    scans.Write(sample);
    std::this_thread::sleep_for(5ms);
  }
}

TEST_F(DdsFaults, AbsurdScansAreRefusedAndTold) {
  Daemon service(Serve({"--output", Path("served")}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  ASSERT_NO_FATAL_FAILURE(PublishAbsurdScans(network_));
  EXPECT_TRUE(service.WaitUntilItSays("its stamp is no time"));
  EXPECT_TRUE(service.WaitUntilItSays("its frame_id is empty"));
  EXPECT_TRUE(service.WaitUntilItSays("it has no ranges"));
  EXPECT_TRUE(service.WaitUntilItSays("it has more than 100000 ranges"));
  EXPECT_EQ(Replay({"--rate", "max"}).exit_code, 0);
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;
  ASSERT_EQ(MapOf().exit_code, 0);
  EXPECT_TRUE(ReadFile(Path("served/robot1/trajectory.tum")) ==
              ReadFile(Path("mapped/trajectory.tum")));
}

}  // namespace
}  // namespace qwsm::test
