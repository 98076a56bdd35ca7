// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Which of the scans that were located extend the map, and from where.
#include <cmath>
#include <optional>
#include <utility>

#include "qwsm/mapping/robot_tracker.hpp"

namespace qwsm {

// Whether the scan is relevant by the thresholds of Visser et al. (2009, section 3), for its laser.
bool RobotTracker::HasMovedOn(const LaserScan& scan,
                              std::span<const ScanPoint> points,
                              const MappingStep& step) const {
  if (step.status == StepStatus::kFirst) return !points.empty();
  const std::optional<Pose2> T_map_before = lasers_.LastFarPoseOf(scan);
  if (!T_map_before) return true;
  const Pose2 moved = T_map_before->Inverse() * step.map_robot.T_a_b;
  return moved.translation_m().norm() > options_.relevant_translation_m ||
         std::abs(moved.theta_rad) > options_.relevant_rotation_rad;
}

void RobotTracker::CloseLoop(const ScanMap& map,
                             const LaserScan& scan,
                             std::span<const ScanPoint> points,
                             MappingStep& step) {
  submap_.Add(step.map_robot.T_a_b, points, scan.geometry.T_robot_laser);
  if (options_.matcher != MatcherKind::kQWsm) return;
  const auto closed = loop_detector_.Detect(
      map, points, submap_.PointsAround(step.map_robot.T_a_b), step.map_robot);
  if (!closed) return;
  step.match = closed->match;
  step.status = StatusOf(closed->match);
  step.reason = "loop closed";
  step.map_robot = closed->map_robot;
  step.local_covariance = closed->match.covariance;
  step.closed_loop = true;
  LeavePath();
}

// What was seen before was seen from another path.
void RobotTracker::LeavePath() {
  submap_.Clear();
  seen_free_.Clear();
  dead_reckoning_.Clear();
  apart_.reset();
}

// What extends the map is what was seen, from where it was seen. Of a robot with several lasers the
// next scan tells more of where that was, so that each waits for the next one.
void RobotTracker::Extend(bool extends,
                          const Observation& observation,
                          std::span<const ScanPoint> points,
                          MappingStep& step) {
  std::optional<HeldScan> held = std::exchange(held_, std::nullopt);
  if (step.closed_loop) held.reset();  // It was seen from a pose that has just been corrected.
  if (held) held->map_robot.T_a_b = lasers_.WithHindsight(held->local, held->observation).T_a_b;
  step.relevant_is_before = held.has_value();
  if (extends) {
    auto passing = seen_free_.MovingAmong(points, step.map_robot.T_a_b);
    bodies_.MarkPassing(points, passing);
    held_ = {.observation = {.scan = WithoutMarked(observation.scan, points, passing),
                             .T_odom_robot = observation.T_odom_robot},
             .map_robot = step.map_robot,
             .local = {.T_a_b = step.map_robot.T_a_b, .covariance = step.local_covariance},
             .T_wheels_robot = gyro_.T_wheels_robot()};
    const bool waits = held || (lasers_.take_turns() && !step.closed_loop);
    if (!waits) held = std::exchange(held_, std::nullopt);
  }
  if (!held) return;
  step.relevant = true;
  step.relevant_scan = std::move(held->observation.scan);
  step.T_odom_relevant = held->T_wheels_robot;
  step.map_relevant = held->map_robot;
}

}  // namespace qwsm
