// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/trajectory_error.hpp"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <optional>

#include "qwsm/metrics/pose_lookup.hpp"

namespace qwsm {

std::vector<PosePair> Associate(Trajectory reference,
                                Trajectory estimate,
                                std::chrono::nanoseconds max_difference) {
  const Trajectory sorted_reference = SortedByStamp(std::move(reference));
  const Trajectory sorted_estimate = SortedByStamp(std::move(estimate));
  const bool estimate_is_longer = sorted_estimate.size() > sorted_reference.size();
  const Trajectory& longer = estimate_is_longer ? sorted_estimate : sorted_reference;
  const Trajectory& shorter = estimate_is_longer ? sorted_reference : sorted_estimate;

  std::vector<PosePair> pairs;
  for (const StampedPose2& pose : shorter) {
    const std::optional<std::size_t> index = NearestIndex(longer, pose.stamp, max_difference);
    if (!index) continue;
    const StampedPose2& partner = longer[*index];
    const StampedPose2& truth = estimate_is_longer ? pose : partner;
    const StampedPose2& estimated = estimate_is_longer ? partner : pose;
    pairs.push_back({.stamp = truth.stamp,
                     .T_ref_robot = truth.T_map_robot,
                     .T_map_robot = estimated.T_map_robot});
  }
  return pairs;
}

Pose2 AlignUmeyama(std::span<const PosePair> pairs) {
  if (pairs.empty()) return {};
  Eigen::Vector2d mean_ref = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_map = Eigen::Vector2d::Zero();
  for (const PosePair& pair : pairs) {
    mean_ref += pair.T_ref_robot.translation_m();
    mean_map += pair.T_map_robot.translation_m();
  }
  mean_ref /= static_cast<double>(pairs.size());
  mean_map /= static_cast<double>(pairs.size());

  // Umeyama (1991), Eq. (40): the rotation R that maximises trace(R^T sum ref map^T). In the plane
  // the singular value decomposition has a closed form: the trace is cosine cos(theta) + sine
  // sin(theta).
  double cosine = 0.0;
  double sine = 0.0;
  for (const PosePair& pair : pairs) {
    const Eigen::Vector2d ref = pair.T_ref_robot.translation_m() - mean_ref;
    const Eigen::Vector2d map = pair.T_map_robot.translation_m() - mean_map;
    cosine += map.dot(ref);
    sine += map.x() * ref.y() - map.y() * ref.x();
  }
  const Pose2 turn{.theta_rad = NormalizeAngle(std::atan2(sine, cosine))};
  const Eigen::Vector2d translation = mean_ref - turn * mean_map;  // Umeyama (1991), Eq. (41).
  return {translation.x(), translation.y(), turn.theta_rad};
}

ErrorStatistics AbsoluteTrajectoryError(std::span<const PosePair> pairs, const Pose2& T_ref_map) {
  std::vector<double> errors_m;
  errors_m.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    const Eigen::Vector2d estimated_ref = T_ref_map * pair.T_map_robot.translation_m();
    errors_m.push_back((estimated_ref - pair.T_ref_robot.translation_m()).norm());
  }
  return Summarize(std::move(errors_m));
}

RelativePoseError EvaluateRelativePoses(std::span<const PosePair> pairs, std::size_t step) {
  assert(step >= 1 && "a motion goes from one pair to another");
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;
  for (std::size_t first = 0; first + step < pairs.size(); first += step) {
    const PosePair& a = pairs[first];
    const PosePair& b = pairs[first + step];
    const Pose2 true_motion = a.T_ref_robot.Inverse() * b.T_ref_robot;
    const Pose2 estimated_motion = a.T_map_robot.Inverse() * b.T_map_robot;
    const Pose2 error = true_motion.Inverse() * estimated_motion;
    translation_m.push_back(error.translation_m().norm());
    rotation_rad.push_back(std::abs(error.theta_rad));
  }
  return {.translation_m = Summarize(std::move(translation_m)),
          .rotation_rad = Summarize(std::move(rotation_rad))};
}

}  // namespace qwsm
