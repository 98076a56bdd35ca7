// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What must not hurt the service: peers that die, come back, send nonsense.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/dds/robot/robot_feed.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/dds/wire/transform_sample.hpp"
#include "tests/support/demo_log.hpp"
#include "tests/support/hostile_peer.hpp"
#include "tests/support/network.hpp"
#include "tests/support/process_state.hpp"
#include "tests/support/replay.hpp"
#include "tests/support/robot_in_room.hpp"
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
  void SetUp() override { WriteDemoLog(Log()); }

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
  Outcome MapOf() const { return RunProgram({"map", Log(), "--output", Path("mapped")}); }

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
  ExpectSamePath(Path("served/robot1"), Path("mapped"));
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
    sample.range_max = -1.0F;
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

/// A stranger who says again and again that a robot's laser sits elsewhere, as long as it lives.
class WrongMounting {
 public:
  explicit WrongMounting(const PrivateNetwork& network)
      : participant_({.interface = "lo", .tag = network.tag()}),
        transforms_(participant_, "/tf_static", dds::Profile::kStaticTransformsOut),
        thread_([this](const std::stop_token& stop) {
          for (double turn_rad = 1.0; !stop.stop_requested(); turn_rad += 0.001) {
            const std::string robot = "robot1/base_link";
            const std::string laser = "robot1/laser";
            const auto pose = dds::ToWire(Pose2{1.0, 0.0, NormalizeAngle(turn_rad)});
            transforms_.Write(dds::TransformSample({}, robot, laser, pose).sample());
            std::this_thread::sleep_for(10ms);
          }
        }) {}

 private:
  dds::Participant participant_;
  dds::Writer<dds::wire::TFMessage> transforms_;
  std::jthread thread_;
};

TEST_F(DdsFaults, StrangersDoNotSayWhereALaserSits) {
  Daemon service(Serve({"--output", Path("served")}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  const WrongMounting stranger(network_);
  const Outcome replay = Replay({"--rate", "max"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_TRUE(service.WaitUntilItSays("/tf_static: a sample was refused: the robot itself says"));
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  ASSERT_EQ(MapOf().exit_code, 0);
  ExpectSamePath(Path("served/robot1"), Path("mapped"));
}

/// Where the lasers of scans sit, and are claimed to.
struct Mountings : team::RobotListener<team::Planar> {
  bool TakeScan(std::string_view, LaserScan scan) override {
    used.push_back(scan.geometry.T_robot_laser);
    return true;
  }
  bool TakeContestedScan(std::string_view, LaserScan scan, const Pose2& told) override {
    claimed.push_back(told);
    return TakeScan({}, std::move(scan));
  }
  void TakeOdometry(std::string_view, Timestamp, const Pose2&) override {}
  void ExpectOdometry(std::string_view, bool) override {}
  void PlaceAt(std::string_view, const UncertainPose2&) override {}

  std::vector<Pose2> used;
  std::vector<Pose2> claimed;
};

TEST(DdsMounting, IsTakenFromWhoComesBackAndContestedWhileHeDrives) {
  const PrivateNetwork network;
  const dds::Participant participant({.interface = "lo", .tag = network.tag()});
  dds::Refusals refusals([](const std::string&) {});
  dds::RobotFeed feed(participant, dds::RobotNames("robot1"), {"scan"}, refusals);
  Mountings heard;
  const auto hear = [&] {
    for (int i = 0; i < 20; ++i) feed.Deliver(10ms, heard);
  };
  Observation observation = ObservationInRoom(0);
  const auto join = [&](double x_m) {
    hear();  // That whoever was there has left.
    observation.scan.geometry.T_robot_laser = {x_m, 0.0, 0.0};
    auto robot = std::make_unique<dds::RobotPublisher>(
        participant, dds::RobotNames("robot1"), dds::OdometryUse::kPublished);
    EXPECT_TRUE(robot->WaitForListener(observation.scan.geometry.T_robot_laser, 10s));
    return robot;
  };
  const auto publish = [&](dds::RobotPublisher& robot) {
    robot.Publish(observation);
    const std::size_t before = heard.used.size();
    for (int i = 0; i < 500 && heard.used.size() == before; ++i) feed.Deliver(10ms, heard);
  };
  publish(*join(0.2));
  const auto robot = join(0.5);
  publish(*robot);
  EXPECT_EQ(heard.used, std::vector<Pose2>({{0.2, 0.0, 0.0}, {0.5, 0.0, 0.0}}));
  EXPECT_TRUE(heard.claimed.empty());

  const dds::Writer<dds::wire::TFMessage> transforms(
      participant, "/tf_static", dds::Profile::kStaticTransformsOut);
  const std::string base = "robot1/base_link";
  const std::string laser = "robot1/laser";
  transforms.Write(
      dds::TransformSample({}, base, laser, dds::ToWire(Pose2{0.9, 0.0, 0.0})).sample());
  hear();
  publish(*robot);
  EXPECT_EQ(heard.used.back(), (Pose2{0.5, 0.0, 0.0}));
  EXPECT_EQ(heard.claimed, std::vector<Pose2>({{0.9, 0.0, 0.0}}));
}

TEST_F(DdsFaults, WrongInitialPosesAreRefusedOrTakenBack) {
  Daemon service(Serve());
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  RobotInRoom robot(network_);
  ASSERT_GE(robot.DriveUntilAnswered(60).size(), 60U);
  robot.Tell({.T_a_b = robot.T_map_robot(), .covariance = 1e300 * Eigen::Matrix3d::Identity()});
  robot.Tell({.T_a_b = {1e300, 0.0, 0.0}});
  for (const Pose2& wrong : {Pose2{3.0, 1.0, 1.0}, Pose2{19999.0, 19999.0, 0.0}}) {
    robot.Tell(UncertainPose2::WithSigmas(robot.T_map_robot() * wrong, 0.5, 0.26));
    std::this_thread::sleep_for(100ms);  // It is best effort: nobody says that it arrived.
    const std::vector<dds::MatchReport> reports = robot.DriveUntilAnswered(40);
    ASSERT_GE(reports.size(), 40U);
    const Pose2 error = reports.back().map_robot.T_a_b.Inverse() * robot.T_map_robot();
    EXPECT_LT(error.translation_m().norm(), 0.3);  // Not all that was sent is answered yet.
  }
  // From the nearer one its scans may have found back to the right place themselves.
  const auto some = [](const std::string& count) { return count != "0"; };
  EXPECT_TRUE(robot.DriveUntil("qwsm: robot1", "contradicted_poses", some));
  const Outcome served = service.End();
  for (const char* told : {"the covariance is larger than that of a pose anywhere on Earth",
                           "its pose is not finite, or more than 10000 km away",
                           "is not where it was told, says the map: it is back"}) {
    EXPECT_NE(served.errors.find(told), std::string::npos) << told << '\n' << served.errors;
  }
  EXPECT_NE(served.output.find(" initial poses contradicted"), std::string::npos) << served.output;
}

TEST_F(DdsFaults, AbsurdScansAreRefusedAndTold) {
  Daemon service(Serve({"--output", Path("served")}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as"));
  ASSERT_NO_FATAL_FAILURE(PublishAbsurdScans(network_));
  EXPECT_TRUE(service.WaitUntilItSays("its stamp is no time"));
  EXPECT_TRUE(service.WaitUntilItSays("its frame_id is empty"));
  EXPECT_TRUE(service.WaitUntilItSays("range limits are not 0 <= minimum < maximum"));
  EXPECT_TRUE(service.WaitUntilItSays("it has no ranges"));
  EXPECT_TRUE(service.WaitUntilItSays("it has more than 100000 ranges"));
  EXPECT_EQ(Replay({"--rate", "max"}).exit_code, 0);
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;
  ASSERT_EQ(MapOf().exit_code, 0);
  ExpectSamePath(Path("served/robot1"), Path("mapped"));
}

}  // namespace
}  // namespace qwsm::test
