// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/node_maker.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace qwsm {
namespace {

constexpr double kToldAhead_m = 0.25;
constexpr double kAnsweredAhead_m = 0.2;

// The answers to a robot that drives ahead: it is found less far than odometry tells.
class DrivingRobot {
 public:
  MappingStep Step(bool is_relevant, bool adds_up) {
    MappingStep step;
    step.stamp = std::chrono::seconds(++scans_);
    step.map_robot.T_a_b.x_m = kAnsweredAhead_m * scans_;
    step.odometry_motion = UncertainPose2::WithSigmas({.x_m = kToldAhead_m}, 0.01, 0.001);
    step.odometry_adds_up = adds_up;
    step.relevant = is_relevant;
    step.relevant_scan.stamp = step.stamp;
    step.map_relevant = step.map_robot;
    return step;
  }

 private:
  int scans_ = 0;
};

TEST(NodeMaker, BelievesTheAnswersWhereOneMotionDoesNotAddUp) {
  DrivingRobot robot;
  NodeMaker nodes;
  EXPECT_FALSE(nodes.Take(robot.Step(true, true))->T_last_node) << "there is none before";
  EXPECT_FALSE(nodes.Take(robot.Step(false, false)));
  const auto node = nodes.Take(robot.Step(true, true));
  EXPECT_NEAR(node->T_last_node->x_m, 2.0 * kAnsweredAhead_m, 1e-12);
  EXPECT_NEAR(node->odometry.T_a_b.x_m, 2.0 * kToldAhead_m, 1e-12);
}

TEST(NodeMaker, BelievesOdometryThatAddsUp) {
  DrivingRobot robot;
  NodeMaker nodes;
  nodes.Take(robot.Step(true, false));
  nodes.Take(robot.Step(false, true));
  const auto node = nodes.Take(robot.Step(true, true));
  EXPECT_NEAR(node->T_last_node->x_m, 2.0 * kToldAhead_m, 1e-12);
}

TEST(NodeMaker, DoesNotContinueAPathThatALoopHasMoved) {
  DrivingRobot robot;
  NodeMaker nodes;
  nodes.Take(robot.Step(true, true));
  MappingStep closed = robot.Step(true, true);
  closed.closed_loop = true;
  EXPECT_FALSE(nodes.Take(closed)->T_last_node);
}

// Where lasers take turns, the relevant scan is the one before: what moved the robot since counts
// for the next node.
TEST(NodeMaker, CountsTheMotionSinceAScanThatWaited) {
  DrivingRobot robot;
  NodeMaker nodes;
  nodes.Take(robot.Step(true, true));
  nodes.Take(robot.Step(false, true));
  MappingStep late = robot.Step(true, false);
  late.relevant_is_before = true;
  EXPECT_NEAR(nodes.Take(late)->T_last_node->x_m, kToldAhead_m, 1e-12);
  MappingStep next = robot.Step(true, true);
  next.map_relevant.T_a_b.x_m = late.map_relevant.T_a_b.x_m + kAnsweredAhead_m;
  const auto node = nodes.Take(next);
  EXPECT_NEAR(node->odometry.T_a_b.x_m, 2.0 * kToldAhead_m, 1e-12);
  EXPECT_NEAR(node->T_last_node->x_m, kAnsweredAhead_m, 1e-12) << "one motion did not add up";
}

}  // namespace
}  // namespace qwsm
