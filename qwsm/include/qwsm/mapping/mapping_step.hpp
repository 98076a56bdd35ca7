// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/matching/match_result.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// Tells where a pose comes from.
enum class StepStatus {
  kFirst,         ///< The first scan: it defines the map's frame.
  kMatched,       ///< The match is the pose.
  kExtended,      ///< The match is the pose, and much of the scan is new to the map.
  kDeadReckoned,  ///< The match was bad: the pose is the prediction.
  kLost,  ///< Where in the map the robot is is not known: the pose is in a frame of its own.
};

std::string_view Name(StepStatus status);

/// The mapper's answer to one observation.
struct MappingStep {
  Timestamp stamp{};
  /// Motion since the last scan as odometry tells it, as uncertain as it has proved to be.
  UncertainPose2 odometry_motion{};
  /// Whether the error of that motion is random, so that a sum of many grows no faster than their
  /// noise: the heading is a gyro's, the creep of the wheels is taken out, and nothing slipped.
  bool odometry_adds_up = false;
  UncertainPose2 map_robot{};  ///< Covariance of all error since the start.
  /// Covariance of the error relative to the map around the robot, without the drift of that map.
  Eigen::Matrix3d local_covariance = Eigen::Matrix3d::Zero();
  StepStatus status = StepStatus::kFirst;
  std::string_view reason{};  ///< Why that status, in words.
  MatchResult match{};        ///< The match that gave the pose, or the bad one that did not.
  bool closed_loop = false;   ///< The pose does not continue the one before.
  int epoch = 0;              ///< How often the map was corrected before this scan.
  bool relevant = false;      ///< Whether the map is to be extended with `relevant_scan`.
  /// Whether that is the scan before this one, of which this one has told more: where lasers take
  /// turns.
  bool relevant_is_before = false;
  /// The scan without the beams that ended on what moves; empty unless it is relevant.
  LaserScan relevant_scan{};
  UncertainPose2 map_relevant{};           ///< Where the relevant scan was taken.
  std::optional<Pose2> T_odom_relevant{};  ///< Odometry at its stamp.
};

}  // namespace qwsm
