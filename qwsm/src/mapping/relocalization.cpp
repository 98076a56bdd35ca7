// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/relocalization.hpp"

#include <algorithm>
#include <vector>

#include "qwsm/matching/mode_search.hpp"

namespace qwsm {
namespace {

constexpr double kAroundMappedPath_m = 2.0;  // The robot may stand a little off its old path.

// The first mode that is not just another pose at the best one's place.
std::optional<FoundPose> RivalAmong(const FoundModes& found, double rival_distance_m) {
  const Eigen::Vector2d best_m = found.modes.front().T_map_robot.translation_m();
  const auto rival = std::ranges::find_if(found.modes, [&](const FoundPose& mode) {
    return (mode.T_map_robot.translation_m() - best_m).norm() > rival_distance_m;
  });
  if (rival != found.modes.end()) return *rival;
  // What was not searched may be as good.
  if (found.floor_score >= found.modes.front().score) return found.modes.front();
  return std::nullopt;
}

}  // namespace

std::optional<RelocalizationResult> Relocalize(const ScanMap& map,
                                               std::span<const ScanPoint> points,
                                               const RelocalizationOptions& options) {
  const FoundModes found = SearchModes(map.surfaces().likelihood(),
                                       PositionsOf(ThinOut(points, options.spacing_m)),
                                       {.places_m = PathOf(map),
                                        .reach_m = kAroundMappedPath_m,
                                        .min_score = options.min_score,
                                        .margin = options.rival_margin});
  if (found.modes.empty()) return std::nullopt;
  return RelocalizationResult{.best = found.modes.front(),
                              .rival = RivalAmong(found, options.rival_distance_m)};
}

}  // namespace qwsm
