// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/matching/correlative_search.hpp"

namespace qwsm {

/// When a loop counts as closed, and where its other end is looked for.
struct LoopClosureOptions {
  CorrelativeSearchOptions search{.prior_cost_points = 0.15, .lever_m = 8.0};
  double sigma_inflation = 6.0;
  double min_drift_m = 0.5;
  double max_drift_share = 0.5;
  double min_revisited_share = 0.5;
  double window_sigmas = 2.5;
  double max_window_m = 4.0;
  double max_window_rad = 0.35;
  double min_score = 0.3;
  double uniqueness = 0.06;
  double min_overlap = 0.7;
};

template <class Visitor>
void Describe(Visitor& visit, LoopClosureOptions& o) {
  visit("search", o.search, {.help = "the search among surfaces with little drift"});
  visit("sigma_inflation",
        o.sigma_inflation,
        {.help = "sigmas of the drift are taken as this many times what the error model says",
         .formerly = "caution",
         .min = 1,
         .max = 100});
  visit("min_drift_m",
        o.min_drift_m,
        {.help = "sigma of the drift since, from which on to look", .min = 0.01, .max = 100});
  visit("max_drift_share",
        o.max_drift_share,
        {.help = "a loop is closed with surfaces of less than this share of today's variance",
         .min = 0,
         .max = 1});
  visit("min_revisited_share",
        o.min_revisited_share,
        {.help = "share of the submap that has to end near such surfaces",
         .formerly = "min_known_share",
         .min = 0,
         .max = 1});
  visit("window_sigmas",
        o.window_sigmas,
        {.help = "half the window, in sigmas of the drift", .min = 0, .max = 10});
  visit("max_window_m",
        o.max_window_m,
        {.help = "most that half the search window measures", .min = 0, .max = 100});
  visit("max_window_rad",
        o.max_window_rad,
        {.help = "most that half the range of headings measures", .min = 0, .max = 3.2});
  visit("min_score", o.min_score, {.help = "score of a loop closure", .min = 0, .max = 1});
  visit("uniqueness",
        o.uniqueness,
        {.help = "by how much the score must beat that of every other place", .min = 0, .max = 1});
  visit("min_overlap",
        o.min_overlap,
        {.help = "share of the scan that then agrees with such surfaces", .min = 0, .max = 1});
}

}  // namespace qwsm
