// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where robots of a team were, in the map as it is at the end.
#include "service/pipeline/team/robot_path.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <vector>

namespace qwsm::pipeline {
namespace {

using namespace std::chrono_literals;

constexpr team::MapVersion kComponent{.map = 2, .epoch = 0};
constexpr team::MapVersion kJoined{.map = 1, .epoch = 1};
// Where the component's frame came to lie.
const Pose2 kT_map_component{10.0, 5.0, 0.5};

// One metre a second along x.
Pose2 Driven(Timestamp stamp) { return {std::chrono::duration<double>(stamp).count(), 0.0, 0.0}; }

/// A robot that is answered once a second, in frames as they are then.
class Drive {
 public:
  void Answer(bool is_relevant, const team::MapVersion& version, const Pose2& T_map_drive = {}) {
    team::RobotAnswer answer{.robot = "r", .step = {}, .version = version};
    answer.step.stamp = stamp_;
    answer.step.map_robot.T_a_b = T_map_drive * Driven(stamp_);
    answer.step.relevant = is_relevant;
    if (is_relevant) answer.step.map_relevant = answer.step.map_robot;
    if (is_relevant) answer.step.relevant_scan.stamp = stamp_;
    if (last_relevant_) {
      answer.last_relevant = {
          .stamp = *last_relevant_,
          .map_robot = {.T_a_b = T_map_drive * Driven(*last_relevant_)},
      };
    }
    path_.Take(answer);
    if (is_relevant) last_relevant_ = stamp_;
    stamp_ += 1s;
  }
  /// The next answer is to a scan of the same time as the last one.
  void StayInTime() { stamp_ -= 1s; }
  /// Another scan than those answered as relevant has extended the map.
  void Extend(Timestamp stamp) { last_relevant_ = stamp; }
  void BeginInAnotherMap() { last_relevant_.reset(); }

  std::vector<io::PathPose> PathIn(const RobotInMap& end) const {
    return path_.PathOf(path_.In(end));
  }

 private:
  RobotPath path_;
  Timestamp stamp_ = 0s;
  std::optional<Timestamp> last_relevant_;
};

void ExpectNear(const io::PathPose& pose, const Pose2& expected) {
  EXPECT_NEAR(pose.map_robot.T_a_b.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(pose.map_robot.T_a_b.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(pose.map_robot.T_a_b.theta_rad, expected.theta_rad, 1e-9);
}

TEST(RobotPath, GoesOnFromAComponentIntoTheMapItJoined) {
  Drive drive;
  drive.Answer(true, kComponent);
  for (int i = 0; i < 3; ++i) drive.Answer(false, kComponent);
  for (int i = 0; i < 4; ++i) drive.Answer(false, kJoined, kT_map_component);
  const auto path = drive.PathIn({.map = 1, .map_robot = {{0s, {.T_a_b = kT_map_component}}}});
  ASSERT_EQ(path.size(), 8U);
  for (const io::PathPose& pose : path) ExpectNear(pose, kT_map_component * Driven(pose.stamp));
}

TEST(RobotPath, GoesFromTheCorrectionOfOneRelevantScanToThatOfTheNext) {
  Drive drive;
  drive.Answer(true, kJoined);
  drive.Answer(false, kJoined);
  drive.Answer(true, kJoined);
  const Pose2 aside{0.0, 0.2, 0.0};
  const auto path =
      drive.PathIn({.map = 1, .map_robot = {{0s, {}}, {2s, {.T_a_b = aside * Driven(2s)}}}});
  ASSERT_EQ(path.size(), 3U);
  ExpectNear(path[0], Driven(0s));
  ExpectNear(path[1], Pose2{0.0, 0.1, 0.0} * Driven(1s));
  ExpectNear(path[2], aside * Driven(2s));
}

TEST(RobotPath, LeavesOutWhatTheMapKnowsNothingOf) {
  Drive drive;
  drive.Answer(true, kComponent);
  drive.Answer(false, kComponent);
  drive.BeginInAnotherMap();
  drive.Answer(false, kComponent);
  drive.Answer(true, kJoined);
  drive.Answer(false, kJoined);
  const auto path = drive.PathIn({.map = 1, .map_robot = {{3s, {.T_a_b = Driven(3s)}}}});
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(path.front().stamp, Timestamp(3s));
  EXPECT_EQ(path.back().stamp, Timestamp(4s));
}

TEST(RobotPath, HangsOnScansThatExtendedTheMapLater) {
  Drive drive;
  drive.Answer(true, kJoined);
  drive.Answer(false, kJoined);
  drive.Extend(1s);
  drive.Answer(false, kJoined);
  const Pose2 aside{0.0, 0.2, 0.0};
  const auto path =
      drive.PathIn({.map = 1, .map_robot = {{0s, {}}, {1s, {.T_a_b = aside * Driven(1s)}}}});
  ASSERT_EQ(path.size(), 3U);
  ExpectNear(path[1], Driven(1s));
  ExpectNear(path[2], aside * Driven(2s));
}

TEST(RobotPath, TellsScansOfSeveralLasersAtTheSameTimeApart) {
  Drive drive;
  drive.Answer(true, kJoined);
  drive.StayInTime();
  drive.Answer(true, kJoined);
  const Pose2 aside{0.0, 0.2, 0.0};
  const auto path = drive.PathIn({.map = 1, .map_robot = {{0s, {}}, {0s, {.T_a_b = aside}}}});
  ASSERT_EQ(path.size(), 2U);
  ExpectNear(path[0], {});
  ExpectNear(path[1], aside);
}

TEST(RobotPath, IsThatOfTheAnswersInAMapThatTheRobotHasNotExtended) {
  Drive drive;
  for (int i = 0; i < 3; ++i) drive.Answer(false, kJoined);
  const auto path = drive.PathIn({.map = 1, .map_robot = {}});
  ASSERT_EQ(path.size(), 3U);
  for (const io::PathPose& pose : path) EXPECT_EQ(pose.map_robot.T_a_b, Driven(pose.stamp));
  EXPECT_TRUE(drive.PathIn({.map = 3, .map_robot = {}}).empty());
  EXPECT_TRUE(Drive().PathIn({.map = 1, .map_robot = {}}).empty());
}

}  // namespace
}  // namespace qwsm::pipeline
