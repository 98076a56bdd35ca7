// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_in_map.hpp"

#include <Eigen/LU>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/matching/mode_probability.hpp"

namespace qwsm {

PoseInMap InMap(const ScanMap& map,
                std::span<const ScanPoint> points,
                const Eigen::Matrix3d& predicted,
                const Eigen::Matrix3d& motion,
                const MatchResult& match) {
  const Pose2& T_map_robot = match.T_ref_cur;
  const Eigen::Matrix3d reference =
      map.CovarianceUnder(points, T_map_robot).At(T_map_robot.translation_m());
  const Eigen::Matrix3d drift = PositivePart(predicted - motion - reference);
  const Eigen::Matrix3d relative = drift + motion;
  const Eigen::Matrix3d known = (match.pair_information + relative.inverse()).inverse();
  return {.map_robot = {.T_a_b = T_map_robot, .covariance = reference + known},
          .sigma_m = UncertainPose2{.T_a_b = T_map_robot, .covariance = drift}.SigmaXY_m()};
}

double ProbabilityOfPose(const ScanMap& map,
                         std::span<const ScanPoint> points,
                         const MatchResult& match,
                         double sigma_m) {
  const double asked_nats = NatsAskedOfPlace(sigma_m);
  if (asked_nats > 0.0) {
    const PlaceFit fit{.told = PlaceEvidence::ToldBySurfaces(points), .explained = match.overlap};
    if (fit.NatsInOwnMap() < asked_nats) return 0.0;
  }
  return ProbabilityOfMode(map.surfaces().likelihood(), points, match);
}

Eigen::Matrix3d CovarianceOfEither(const UncertainPose2& pose,
                                   double probability,
                                   const UncertainPose2& other) {
  return probability * pose.covariance + (1.0 - probability) * About(pose.T_a_b, other).covariance;
}

}  // namespace qwsm
