// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How a correction of the map reaches who drives by `map` -> `odom`.
#include "service/team/session/correction_easing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "service/team/service/team_service.hpp"
#include "tests/support/moved_map.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

/// A robot whose odometry is right, and a map that may be corrected.
class Robot {
 public:
  explicit Robot(const CorrectionOptions& options) : easing_(options) {}

  void Correct(const Pose2& T_map_odom) {
    easing_.Correct(T_map_odom_ * T_odom_robot_, T_map_odom * T_odom_robot_);
    T_map_odom_ = T_map_odom;
  }
  void Forget() { easing_.Forget(); }
  void SetClock(Timestamp stamp) { stamp_ = stamp; }
  /// Goes on for a tenth of a second. @returns map -> odom as it is told.
  Pose2 Drive(double speed_mps) {
    stamp_ += 100ms;
    T_odom_robot_ = T_odom_robot_ * Pose2{.x_m = 0.1 * speed_mps};
    MappingStep step;
    step.stamp = stamp_;
    step.map_robot.T_a_b = T_map_odom_ * T_odom_robot_;
    return easing_.Tell(step, T_odom_robot_).value_or(step.map_robot).T_a_b *
           T_odom_robot_.Inverse();
  }

 private:
  CorrectionEasing easing_;
  Timestamp stamp_ = 10s;
  Pose2 T_odom_robot_{};
  Pose2 T_map_odom_{};
};

void ExpectNear(const Pose2& pose, const Pose2& expected) {
  EXPECT_NEAR(pose.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(pose.theta_rad, expected.theta_rad, 1e-9);
}

const Pose2 kCorrected{.x_m = 0.3, .y_m = -0.4, .theta_rad = 0.02};

TEST(CorrectionEasing, NowIsWithTheNextScan) {
  Robot robot({});
  robot.Drive(1.0);
  robot.Correct(kCorrected);
  ExpectNear(robot.Drive(1.0), kCorrected);
}

TEST(CorrectionEasing, RestWaitsUntilTheRobotHasStoodForASecond) {
  Robot robot({.policy = CorrectionPolicy::kRest});
  for (int i = 0; i < 50; ++i) ExpectNear(robot.Drive(1.0), {});
  robot.Correct({.x_m = 1.0, .theta_rad = 0.5});
  ExpectNear(robot.Drive(1.0), {});
  robot.Correct(kCorrected);  // Two that come before it stands are one.
  for (int i = 0; i < 50; ++i) ExpectNear(robot.Drive(1.0), {});
  for (int i = 0; i < 9; ++i) ExpectNear(robot.Drive(0.0), {});
  ExpectNear(robot.Drive(0.0), kCorrected);
  ExpectNear(robot.Drive(1.0), kCorrected);
}

TEST(CorrectionEasing, RestIsNoLongerForAClockThatWasSetBack) {
  Robot robot({.policy = CorrectionPolicy::kRest});
  for (int i = 0; i < 5; ++i) robot.Drive(0.0);
  robot.Correct(kCorrected);
  robot.SetClock(-1000s);
  for (int i = 0; i < 10; ++i) ExpectNear(robot.Drive(0.0), {});
  ExpectNear(robot.Drive(0.0), kCorrected);
}

TEST(CorrectionEasing, SlewIsNoFasterThanItIsSaid) {
  constexpr double kStep_m = 0.1 * 0.1;
  Robot robot({.policy = CorrectionPolicy::kSlew, .slew_mps = 0.1});
  for (int i = 0; i < 100; ++i) robot.Drive(1.0);  // Ten metres off, where turns are far.
  robot.Correct(kCorrected);
  Pose2 T_odom_robot{.x_m = 10.0};
  Pose2 last = T_odom_robot;
  int scans = 0;
  for (; scans < 100; ++scans) {
    T_odom_robot.x_m += 0.1;
    const Pose2 told = robot.Drive(1.0) * T_odom_robot;
    const double went_m = (told.translation_m() - last.translation_m()).norm();
    EXPECT_NEAR(went_m, 0.1, kStep_m + 1e-3);
    last = told;
    const Pose2 left = (kCorrected * T_odom_robot).Inverse() * told;
    if (left.translation_m().norm() < 1e-9) break;
  }
  // Ten metres off the turn undoes a part of the shift to the right.
  const double distance_m =
      ((kCorrected * Pose2{.x_m = 10.0}).translation_m() - Eigen::Vector2d(10.0, 0.0)).norm();
  EXPECT_NEAR(scans, distance_m / kStep_m, 3.0);
  ExpectNear(robot.Drive(1.0), kCorrected);
}

TEST(CorrectionEasing, WhoIsPlacedAnewIsToldAtOnce) {
  Robot robot({.policy = CorrectionPolicy::kRest});
  robot.Drive(1.0);
  robot.Correct(kCorrected);
  robot.Forget();
  ExpectNear(robot.Drive(1.0), kCorrected);
}

TEST(CorrectionOptions, WhatIsSaidForOneRobotCounts) {
  TeamCorrectionOptions options;
  options.policy = CorrectionPolicy::kRest;
  options.robots.push_back({{.policy = CorrectionPolicy::kNow}, "robot2"});
  EXPECT_EQ(CorrectionOf(options, "robot1").policy, CorrectionPolicy::kRest);
  EXPECT_EQ(CorrectionOf(options, "robot2").policy, CorrectionPolicy::kNow);
}

/// What a service tells of poses.
class PoseSink final : public test::RecordingSink {
 public:
  void TakeAnswer(const RobotAnswer& answer) override {
    test::RecordingSink::TakeAnswer(answer);
    answers.push_back(answer);
  }
  std::vector<RobotAnswer> answers;  // Of one robot: told one by one.
};

/// Drives through a room, with a correction by another service on the way.
std::vector<RobotAnswer> DriveThroughACorrection(CorrectionPolicy policy) {
  constexpr int kBefore = 60;
  constexpr int kAfter = 30;
  PoseSink sink;
  TeamServiceOptions options;
  options.team.session.queue_scans = 1000;
  options.team.session.odometry_wait_s = 10.0;
  options.team.map_period_s = 0.0;
  options.team.correction.policy = policy;
  TeamService service(options, sink);
  service.Start();
  const auto give = [&](int first, int count) {
    for (int scan = first; scan < first + count; ++scan) {
      const Observation observation = test::ObservationInRoom(scan);
      service.robots().TakeOdometry("robot1", observation.scan.stamp, *observation.T_odom_robot);
      service.robots().TakeScan("robot1", observation.scan);
    }
    service.WaitUntilIdle();
  };
  give(0, kBefore);
  service.TakeIn(test::Moved(sink.relevant(), {.x_m = 0.5}, {.number = 1, .service = "z"}));
  service.WaitUntilIdle();
  give(kBefore, kAfter);
  service.Stop();
  EXPECT_EQ(sink.epochs().size(), 1U);
  return sink.answers;
}

/// The longest way between two poses that are told, in metres; each stamp is told once, in order.
double LongestWay_m(const std::vector<RobotAnswer>& answers) {
  double longest_m = 0.0;
  for (std::size_t i = 1; i < answers.size(); ++i) {
    EXPECT_LT(answers[i - 1].step.stamp, answers[i].step.stamp);
    const auto told = [](const RobotAnswer& answer) {
      return answer.told.value_or(answer.step.map_robot).T_a_b.translation_m();
    };
    longest_m = std::max(longest_m, (told(answers[i]) - told(answers[i - 1])).norm());
  }
  return longest_m;
}

TEST(CorrectionEasing, ServicesTellByPolicyAndMatchInTheCorrectedMap) {
  const std::vector<RobotAnswer> now = DriveThroughACorrection(CorrectionPolicy::kNow);
  const std::vector<RobotAnswer> rest = DriveThroughACorrection(CorrectionPolicy::kRest);
  const std::vector<RobotAnswer> slew = DriveThroughACorrection(CorrectionPolicy::kSlew);
  EXPECT_GT(LongestWay_m(now), 0.4);
  EXPECT_LT(LongestWay_m(rest), 0.15);
  EXPECT_LT(LongestWay_m(slew), 0.15);
  ASSERT_EQ(rest.size(), now.size());
  ASSERT_EQ(slew.size(), now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(rest[i].step.map_robot.T_a_b, now[i].step.map_robot.T_a_b);
    EXPECT_EQ(slew[i].step.map_robot.T_a_b, now[i].step.map_robot.T_a_b);
    EXPECT_FALSE(now[i].told);
  }
  EXPECT_TRUE(rest.back().told);  // It has driven all the time.
}

}  // namespace
}  // namespace qwsm::team
