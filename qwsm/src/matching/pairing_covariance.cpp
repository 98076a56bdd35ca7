// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Core>
#include <cmath>

#include "pairing.hpp"
#include "qwsm/matching/pair_error.hpp"

namespace qwsm {
namespace {

Eigen::Matrix3d Square(const Eigen::Vector3d& v) { return v * v.transpose(); }

// What a pair tells of the position of its scan point, in 1/m^2 and map axes.
Eigen::Matrix2d PairInformation(const Surface& surface,
                                const Eigen::Matrix2d& N_map,
                                double extent_m2) {
  if (!surface.is_line) return PositionInformation(surface, N_map, extent_m2);
  const Eigen::Vector2d& n = surface.normal;
  return n * n.transpose() / DistanceVariance(surface, n.dot(N_map * n), 0.0);
}

}  // namespace

// A pair as it counts at the pose.
struct Pairing::CountedPair {
  const Pair& pair;
  const ScanPoint& point;
  Eigen::Vector2d arm;    // The point in map axes, from the robot: R u.
  Eigen::Matrix2d N_map;  // Noise of the point in map axes.
  Eigen::Matrix2d W;      // Information of the pair about the point, S^-1, weighted.
};

template <class Visit>
void Pairing::ForEachPair(const Pose2& T_map_cur, Visit visit) const {
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (!pair.id) continue;
    const ScanPoint& point = points_[i];
    const Eigen::Matrix2d N_map = NoiseInMap(R, point);
    visit(CountedPair{.pair = pair,
                      .point = point,
                      .arm = R * point.p_robot_m,
                      .N_map = N_map,
                      .W = pair.weight * PairInformation(pair.surface, N_map, Extent_m2(point))});
  }
}

Eigen::Matrix3d Pairing::ConfirmedInformation(const Pose2& T_map_cur) const {
  NormalEquations equations;
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  ForEachPair(T_map_cur, [&](const CountedPair& p) {
    const Eigen::Vector2d n_scan = R * p.point.normal_robot;
    if (n_scan.isZero()) {
      return equations.AddPoint(p.W, Eigen::Vector2d::Zero(), p.arm);
    }
    const Eigen::Vector2d n_map = p.pair.surface.is_line ? p.pair.surface.normal : n_scan;
    const double w = std::copysign(n_map.dot(p.W * n_map), n_map.dot(n_scan));
    const Eigen::Matrix3d both = PullOnPose(n_map, p.arm) * PullOnPose(n_scan, p.arm).transpose();
    equations.A += 0.5 * w * (both + both.transpose());
  });
  return equations.A;
}

Eigen::Matrix3d Pairing::Scatter(const Pose2& T_map_cur) const {
  Eigen::Matrix3d B = Eigen::Matrix3d::Zero();
  ForEachPair(T_map_cur, [&](const CountedPair& p) {
    const Surface& surface = p.pair.surface;
    const Eigen::Vector2d error = surface.mean_m - p.arm - T_map_cur.translation_m();
    B += Square(PullOnPose(p.W * error, p.arm));
    if (!surface.is_line || surface.is_sample) return;
    // How wrong the mean is, which it shares with the readings around, this one does not show.
    const double noise_of_mean_m2 =
        surface.normal.dot(p.N_map * surface.normal) / surface.observations;
    B += noise_of_mean_m2 * Square(PullOnPose(p.W * surface.normal, p.arm));
  });
  return B;
}

}  // namespace qwsm
