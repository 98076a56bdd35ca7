// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/relocalization.hpp"

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace qwsm {
namespace {

constexpr double kMargin_m = 2.0;      // The robot may stand a little off its old path.
constexpr double kAnywhere_m2 = 1e12;  // No place is more likely than another.

SearchWindow WindowAround(std::span<const RelevantScan> scans) {
  Eigen::AlignedBox2d box;
  for (const RelevantScan& scan : scans) box.extend(scan.map_robot.T_a_b.translation_m());
  SearchWindow window;
  window.predicted.T_a_b = {box.center().x(), box.center().y(), 0.0};
  window.predicted.covariance = Eigen::Matrix3d::Identity() * kAnywhere_m2;
  window.translation_m = 0.5 * box.sizes().maxCoeff() + kMargin_m;
  window.rotation_rad = std::numbers::pi;
  return window;
}

}  // namespace

std::optional<RelocalizationResult> Relocalize(const ScanMap& map,
                                               std::span<const ScanPoint> points,
                                               const RelocalizationOptions& options) {
  const std::vector<Eigen::Vector2d> thinned = PositionsOf(ThinOut(points, options.spacing_m));
  if (map.empty() || thinned.empty()) return std::nullopt;
  const LikelihoodPyramid& likelihood = map.surfaces().likelihood();
  SearchWindow window = WindowAround(map.scans());
  window.min_score = options.min_score;
  const std::optional<FoundPose> best = SearchPose(likelihood, thinned, window, {});
  if (!best) return std::nullopt;

  window.min_score = best->score - options.rival_margin;
  window.exclude = best->T_map_robot;
  window.exclude_m = options.rival_distance_m;
  return RelocalizationResult{.best = *best, .rival = SearchPose(likelihood, thinned, window, {})};
}

}  // namespace qwsm
