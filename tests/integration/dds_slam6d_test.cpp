// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// 3D scans through the network: `slam6d replay` and `slam6d serve` as processes on loopback.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/writer.hpp"
#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "tests/support/drive3.hpp"
#include "tests/support/network.hpp"
#include "tests/support/uos_files.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class DdsSlam6d : public ::testing::Test {
 protected:
  void SetUp() override { slam6d::WriteUosDrive(Path("scans"), drive_); }

  std::string Path(const std::string& name) const { return folder_.path() / name; }
  dds::NetworkOptions Network() const {
    return {.interface = "lo", .tag = network_.tag(), .node = "test"};
  }
  Outcome Run(std::vector<std::string> arguments) const {
    return Program(std::move(arguments), {.output = {}, .program = "slam6d"}).Wait();
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
  slam6d::Drive3 drive_ = slam6d::DriveInCircle(16, 4000, 5);
};

TEST_F(DdsSlam6d, ServesThePosesOfRegisterBitForBit) {
  Daemon service(network_.JoinService({"serve", "--output", Path("served")}), "slam6d");
  const Outcome replay = Run(network_.Join({"replay", Path("scans"), "--rate", "max"}));
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_NE(replay.output.find("answered       16, dropped by the service 0"), std::string::npos)
      << replay.output;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;

  const Outcome registered = Run({"register", Path("scans"), "--output", Path("registered")});
  ASSERT_EQ(registered.exit_code, 0) << registered.errors;
  const std::string expected = ReadFile(Path("registered/trajectory.tum"));
  ASSERT_GT(expected.size(), 1000U);
  EXPECT_EQ(ReadFile(Path("served/trajectory.tum")), expected);
  EXPECT_TRUE(ReadFile(Path("served/model.ply")) == ReadFile(Path("registered/model.ply")));
  for (const char* name : {"top_after.png", "config.yaml", "run.log"}) {
    EXPECT_TRUE(fs::exists(Path(std::string("served/") + name))) << name;
  }
}

TEST_F(DdsSlam6d, ServesSeveralRobotsAtOnceAndTellsTheirMapToThoseWhoComeLater) {
  Daemon service(network_.JoinService({"serve", "--output", Path("served")}), "slam6d");
  const auto replay = [this](const std::string& robot) {
    return network_.Join({"replay", Path("scans"), "--rate", "max", "--robot", robot});
  };
  Program first(replay("robot1"), {.output = {}, .program = "slam6d"});
  Program second(replay("robot2"), {.output = {}, .program = "slam6d"});
  EXPECT_EQ(first.Wait().exit_code, 0);
  EXPECT_EQ(second.Wait().exit_code, 0);

  const dds::Participant late(Network());
  const dds::Reader<dds::wire::PointCloud2> maps(
      late, "/robot1/cloud_map", dds::Profile::kLatchedIn);
  std::size_t points = 0;
  for (int i = 0; i < 1000 && points == 0; ++i, std::this_thread::sleep_for(10ms)) {
    maps.TakeAll([&](const dds::wire::PointCloud2& map) {
      EXPECT_EQ(dds::ObjectionTo(map), "");
      points = dds::FromWire(map).cloud.size();
    });
  }
  EXPECT_GT(points, 1000U);
  EXPECT_EQ(service.End().exit_code, 0);
  EXPECT_EQ(ReadFile(Path("served/robot1/trajectory.tum")),
            ReadFile(Path("served/robot2/trajectory.tum")));
}

TEST_F(DdsSlam6d, RefusesBadCloudsAndAnswersTheGoodOnesBetweenThem) {
  Daemon service(network_.JoinService({"serve"}), "slam6d");
  const dds::Participant participant(Network());
  dds::RegistrationReportReader reports(participant, {"robot1"});
  dds::CloudRobotPublisher robot(
      participant, dds::RobotNames("robot1"), dds::OdometryUse::kPublished);
  ASSERT_TRUE(robot.WaitForListener({}, 10s));
  while (!reports.has_writer()) reports.Take(10ms);
  const dds::Writer<dds::wire::PointCloud2> intruder(
      participant, "/robot1/points", dds::Profile::kSensorOut);
  while (intruder.reader_count() == 0) std::this_thread::sleep_for(5ms);

  const std::string kBadStep = "/robot1/points: a sample was refused: its row_step";
  const std::string kNoFields = "it has no fields x, y and z";
  const std::string frame = "robot1/laser";
  std::size_t answers = 0;
  for (int scan = 0; scan < 4; ++scan) {
    const auto stamp = std::chrono::seconds(scan + 1);
    const dds::CloudSample sample(
        drive_.scans.front(), dds::CloudPrecision::kSingle, stamp - 1ms, frame);
    dds::wire::PointCloud2 bad = sample.sample();
    if (scan % 2 == 0) bad.point_step = 0x7fffffff;
    if (scan % 2 == 1) bad.fields._length = 2;
    ASSERT_TRUE(intruder.Write(bad));
    // The newest sample wins: what is to be refused must have been seen before the good one comes.
    ASSERT_TRUE(service.WaitUntilItSays(scan % 2 == 0 ? kBadStep : kNoFields));
    const auto i = static_cast<std::size_t>(scan);
    ASSERT_TRUE(
        robot.Publish({.scan = {.stamp = stamp, .cloud = drive_.scans[i], .T_robot_sensor = {}},
                       .T_odom_robot = drive_.T_odom_scan[i]}));
    for (int wait = 0; wait < 100 && answers <= i; ++wait) {
      for (const dds::RegistrationReport& report : reports.Take(100ms)) {
        EXPECT_EQ(report.stamp, stamp);
        EXPECT_EQ(report.status,
                  scan == 0 ? slam6d::SlamStatus::kFirst : slam6d::SlamStatus::kMatched);
        const Eigen::Vector3d error_m =
            (drive_.T_room_scan.front().Inverse() * drive_.T_room_scan[i]).translation_m -
            report.map_robot.T_a_b.translation_m;
        EXPECT_LT(error_m.norm(), 0.02);
        ++answers;
      }
    }
  }
  EXPECT_EQ(answers, 4U);
  service.End();
}

TEST_F(DdsSlam6d, SurvivorOfTwoServicesTakesOverTheRobot) {
  Daemon first(network_.JoinService({"serve", "robot1"}), "slam6d");
  const dds::Participant participant(Network());
  dds::RegistrationReportReader reports(participant, {"robot1"});
  while (!reports.has_writer()) reports.Take(10ms);
  Daemon second(network_.JoinService({"serve", "--verbose"}), "slam6d");
  dds::CloudRobotPublisher robot(
      participant, dds::RobotNames("robot1"), dds::OdometryUse::kPublished);
  ASSERT_TRUE(robot.WaitForListener({}, 10s));
  auto stamp = 0s;
  const auto answers_to_one_more = [&] {
    EXPECT_TRUE(
        robot.Publish({.scan = {.stamp = ++stamp, .cloud = drive_.scans[0], .T_robot_sensor = {}},
                       .T_odom_robot = drive_.T_odom_scan[0]}));
    return reports.Take(100ms).size();
  };
  const auto drive_until = [](const auto& is_reached) {
    for (int scan = 0; scan < 300; ++scan) {
      if (is_reached()) return true;
    }
    return false;
  };
  // Time enough for the second service to find the robot, and to leave it to the first one.
  std::size_t answers = 0;
  ASSERT_TRUE(drive_until([&] { return (answers += answers_to_one_more()) >= 20; }));
  const auto times_told = [&](const std::string& what) {
    const std::string errors = second.ErrorsSoFar();
    int times = 0;
    for (auto at = errors.find(what); at != std::string::npos; at = errors.find(what, at + 1)) {
      ++times;
    }
    return times;
  };
  const int joined_before = times_told("robot1: joined");
  EXPECT_EQ(joined_before, times_told("robot1: is answered by another service"));
  first.End(SIGKILL);
  while (!reports.Take(100ms).empty()) continue;
  // Nothing tells of the death but its silence, for ten seconds.
  ASSERT_TRUE(drive_until([&] { return answers_to_one_more() > 0; })) << second.ErrorsSoFar();
  EXPECT_EQ(times_told("robot1: joined"), joined_before + 1) << second.ErrorsSoFar();
  const Outcome survivor = second.End();
  EXPECT_NE(survivor.output.find("robot1"), std::string::npos) << survivor.output;
}

TEST_F(DdsSlam6d, SaysThatNobodyListens) {
  const Outcome replay =
      Run(network_.Join({"replay", Path("scans"), "--robot", "robot7", "--wait", "0.2"}));
  EXPECT_EQ(replay.exit_code, 1);
  EXPECT_NE(replay.errors.find("nobody listens to /robot7/points; is 'slam6d serve' running"),
            std::string::npos)
      << replay.errors;
}

}  // namespace
}  // namespace qwsm::test
