// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

struct RelocalizationOptions {
  double min_score = 0.4;
  double rival_distance_m = 1.0;
  double rival_margin = 0.05;
  double spacing_m = 0.15;
};

template <class Visitor>
void Describe(Visitor& visit, RelocalizationOptions& o) {
  visit("min_score",
        o.min_score,
        {.help = "a scan that fits no place better is not found", .min = 0, .max = 1});
  visit("rival_distance_m",
        o.rival_distance_m,
        {.help = "places this far apart are different ones", .min = 0.1, .max = 100});
  visit("rival_margin",
        o.rival_margin,
        {.help = "a place that fits so little worse may be the right one", .min = 0, .max = 1});
  visit("spacing_m",
        o.spacing_m,
        {.help = "points of the scan this near count once", .min = 0.01, .max = 10});
}

/// Where in a map a scan fits.
struct RelocalizationResult {
  FoundPose best;
  std::optional<FoundPose> rival;  ///< Another place where it fits about as well.
};

/// Finds where in a map a single scan was taken, knowing nothing but the map: the best of all
/// positions near where a robot has been, and of all headings. Whoever can drive on finds more with
/// a PlaceFinder.
/// @return nothing where the scan fits nowhere.
std::optional<RelocalizationResult> Relocalize(const ScanMap& map,
                                               std::span<const ScanPoint> points,
                                               const RelocalizationOptions& options = {});

}  // namespace qwsm
