// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_in_map.hpp"

#include <Eigen/LU>

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {

UncertainPose2 InMap(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const Eigen::Matrix3d& predicted,
                     const Eigen::Matrix3d& motion,
                     const MatchResult& match) {
  const Pose2& T_map_robot = match.T_ref_cur;
  const Eigen::Matrix3d reference =
      map.CovarianceUnder(points, T_map_robot).At(T_map_robot.translation_m());
  const Eigen::Matrix3d relative = PositivePart(predicted - motion - reference) + motion;
  return {.T_a_b = T_map_robot,
          .covariance = reference + (match.pair_information + relative.inverse()).inverse()};
}

Eigen::Matrix3d CovarianceOfEither(const UncertainPose2& pose,
                                   double probability,
                                   const UncertainPose2& other) {
  return probability * pose.covariance + (1.0 - probability) * About(pose.T_a_b, other).covariance;
}

}  // namespace qwsm
