// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bags of several lasers, and of several robots.
#include <gtest/gtest.h>

#include "tests/support/bag_drive.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

MadeMessage StaticTransform(const std::string& frame,
                            const std::string& child,
                            const Transform3& transform) {
  return test::TransformMessageOf(Ros::k1, "/tf_static", 0s, frame, child, transform);
}

TEST_F(Bag, ReadsAllLasersOrThoseThatAreAskedFor) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive.push_back(test::ScanMessage(Ros::k2, "/scan_filtered", At(1), "laser", RangesAt(1)));
  drive.push_back(test::ScanMessage(Ros::k2, "/rear/scan", At(1) + 10ms, "rear", RangesAt(2)));
  drive.push_back(test::TransformMessageOf(
      Ros::k2, "/tf_static", 0s, "base_link", "rear", Spatial({-0.2, 0, std::numbers::pi})));
  const LogContent both = ReadMcap(drive);
  ASSERT_EQ(both.scans.size(), 5U);
  EXPECT_EQ(both.report.other_scans, 1U) << "the filtered one is the same laser's";
  EXPECT_EQ(both.scans[1].laser, "front");
  EXPECT_EQ(both.scans[2].laser, "rear");
  EXPECT_EQ(both.scans[2].scan.geometry.T_robot_laser.x_m, -0.2);
  EXPECT_NEAR(both.scans[2].T_odom_robot->x_m, 0.11, 1e-9) << "the odometry of its own moment";

  LogOptions options;
  options.scan_topics = {"/scan"};
  EXPECT_EQ(ReadMcap(drive, "zstd", options).scans.size(), 4U);
  options.scan_topics = {"/front"};
  EXPECT_NE(FailureOf([&] {
              ReadMcap(drive, "zstd", options);
            }).find("no scans on '/front'; it has them on /rear/scan, /scan, /scan_filtered"),
            std::string::npos);
}

TEST_F(Bag, ReadsTheRobotThatIsAskedFor) {
  std::vector<MadeMessage> team;
  for (const std::string robot : {"/robot1", "/robot2"}) {
    for (MadeMessage message : Drive(Ros::k2)) {
      if (message.topic == "/scan" || message.topic == "/odom") {
        message.topic = robot + message.topic;
      }
      team.push_back(message);
    }
  }
  EXPECT_NE(FailureOf([&] {
              ReadMcap(team);
            }).find("several robots: /robot1, /robot2; choose one with --robot"),
            std::string::npos);
  LogOptions options;
  options.robot = "robot2";
  EXPECT_EQ(ReadMcap(team, "zstd", options).scans.size(), 4U);
  options.robot = "robot3";
  EXPECT_NE(FailureOf([&] { ReadMcap(team, "zstd", options); }).find("robot 'robot3'"),
            std::string::npos);
}

TEST_F(Bag, NamesTheRobotsWhereItIsNotSaidWhoseScansAreMeant) {
  std::vector<MadeMessage> team = Drive(Ros::k2);
  for (const std::string robot : {"/robot1", "/robot2"}) {
    for (MadeMessage message : Drive(Ros::k2)) {
      message.topic = robot + message.topic;
      team.push_back(message);
    }
  }
  team.push_back(test::ScanMessage(Ros::k2, "/robot2/scan", At(9), "laser", RangesAt(0)));
  try {
    ReadMcap(team);
    FAIL() << "it was not asked whose scans are meant";
  } catch (const SeveralRobotsError& several) {
    EXPECT_EQ(several.robots(), (std::vector<std::string>{"robot2", "robot1"}));
  }
}

TEST_F(Bag, TellsRobotsApartThatShareOneTf) {
  std::vector<MadeMessage> team;
  for (const std::string robot : {"robot1", "robot2"}) {
    for (int i = 0; i < 4; ++i) {
      const double speed_m = robot == "robot1" ? 0.1 : 0.2;
      team.push_back(test::TransformMessageOf(Ros::k2,
                                              "/tf",
                                              At(i),
                                              robot + "/odom",
                                              robot + "/base_link",
                                              Spatial({speed_m * i, 0.0, 0.0})));
      for (const std::string laser : {"front", "rear"}) {
        team.push_back(test::ScanMessage(
            Ros::k2, "/" + robot + "/" + laser + "/scan", At(i), robot + "/" + laser, RangesAt(i)));
      }
    }
    for (const std::string laser : {"front", "rear"}) {
      team.push_back(test::TransformMessageOf(Ros::k2,
                                              "/tf_static",
                                              0s,
                                              robot + "/base_link",
                                              robot + "/" + laser,
                                              Spatial(kMounting)));
    }
  }
  EXPECT_THROW(ReadMcap(team), SeveralRobotsError);
  LogOptions options;
  options.robot = "robot2";
  options.scan_topics = {"/robot2/front/scan"};
  const LogContent log = ReadMcap(team, "zstd", options);
  ASSERT_EQ(log.scans.size(), 4U);
  EXPECT_EQ(log.scans[3].T_odom_robot, (Pose2{0.2 * 3, 0.0, 0.0}));
}

TEST_F(Bag, OfOneRobotIsRefusedWhereAnotherIsAskedFor) {
  LogOptions options;
  options.robot = "robot2";
  ExpectDrive(ReadRos1(Drive(Ros::k1), "none", options));  // Any, where it has no name.
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  for (MadeMessage& message : drive) message.topic = "/robot1" + message.topic;
  const std::string refusal = FailureOf([&] { ReadRos1(drive, "none", options); });
  EXPECT_NE(refusal.find("no scans of a robot 'robot2'; it has those of /robot1"),
            std::string::npos)
      << refusal;
  options.robot = "robot1";
  ExpectDrive(ReadRos1(drive, "none", options));
  // Of a part of a recording in which but one of them tells odometry.
  drive.push_back(test::ScanMessage(Ros::k1, "/robot2/scan", At(9), "laser2", RangesAt(0)));
  EXPECT_EQ(ReadRos1(drive, "none", options).scans.size(), 4U);
}

TEST_F(Bag, FindsTheMountingWhereOdometryDoesNotNameTheRobot) {
  const Quaternion rolled{1.0, 0.0, 0.0, 0.0};
  for (const bool has_odometry : {true, false}) {
    std::vector<MadeMessage> drive{
        StaticTransform("base_link", "mast", Spatial({0.2, 0.0, 0.0})),
        StaticTransform("mast", "laser", {.rotation = rolled}),
    };
    for (int i = 0; i < 4; ++i) {
      if (has_odometry) {
        drive.push_back(test::OdometryMessageOf(Ros::k1, "/odom", At(i), "", OdometryAt(i)));
      }
      drive.push_back(test::ScanMessage(Ros::k1, "/scan", At(i), "laser", RangesAt(i)));
    }
    const LogContent log = ReadRos1(drive);
    ASSERT_EQ(log.scans.size(), 4U);
    EXPECT_EQ(log.scans[0].scan.geometry.first_bearing_rad, 1.0F) << "it is upside down";
    EXPECT_NEAR(log.scans[0].scan.geometry.T_robot_laser.x_m, 0.2, 1e-12);
  }
}

TEST_F(Bag, PrefersOdometryOfTheFrameThatTheLaserSitsOnThenThatOfTheRobot) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  for (int i = 0; i < 8; ++i) {  // Both are told more often.
    drive.push_back(test::OdometryMessageOf(Ros::k1, "/gps/odom", At(i), "antenna", {9, 9, 9}));
    drive.push_back(test::OdometryMessageOf(Ros::k1, "/eye/odom", At(i), "base_link", {9, 9, 9}));
  }
  EXPECT_EQ(ReadRos1(drive).scans.at(1).T_odom_robot, OdometryAt(1));
  std::erase_if(drive, [](const MadeMessage& message) { return message.topic == "/eye/odom"; });
  for (MadeMessage& message : drive) {
    if (message.topic == "/odom") message.topic = "/wheels";
  }
  EXPECT_EQ(ReadRos1(drive).scans.at(1).T_odom_robot, OdometryAt(1));
}

TEST_F(Bag, TakesTheLastOfFixedTransformsThatAreSentAnew) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  drive.insert(drive.begin(), StaticTransform("base_link", "laser", Spatial({5.0, 0.0, 0.0})));
  EXPECT_EQ(ReadRos1(drive).scans.at(0).scan.geometry.T_robot_laser, kMounting);
}

}  // namespace
}  // namespace qwsm::io
