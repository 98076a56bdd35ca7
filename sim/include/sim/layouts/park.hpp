// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"
#include "sim/random.hpp"

namespace sim {

/// 'The Park' of Visser et al. (2009), section 4.1: trees and little else.
struct ParkOptions {
  double width_m = 80.0;
  double height_m = 40.0;
  int groups = 3;  ///< Groups of trees along the way.
  int trees_per_group = 5;
  double group_radius_m = 4.0;
  double min_trunk_radius_m = 0.12;
  double max_trunk_radius_m = 0.4;
  double clearance_m = 2.0;  ///< No trunk stands nearer to the way than this.
  /// Share of the way, round the sharp turn, in which few trees are in view.
  double lonely_share = 0.4;
  int lonely_in_view = 2;  ///< Trees in view on the lonely share of the way.
  int usual_in_view = 4;   ///< Fewest trees in view on the rest of the way.
};

template <class Visitor>
void Describe(Visitor& visit, ParkOptions& o) {
  visit("width_m", o.width_m, {.help = "extent in x", .min = 40, .max = 1000});
  visit("height_m", o.height_m, {.help = "extent in y", .min = 30, .max = 1000});
  visit("groups", o.groups, {.help = "groups of trees along the way", .min = 1, .max = 1000});
  visit("trees_per_group", o.trees_per_group, {.help = "trees in a group", .min = 1, .max = 100});
  visit("group_radius_m",
        o.group_radius_m,
        {.help = "how far the trees of a group stand from its middle", .min = 1, .max = 50});
  visit("min_trunk_radius_m",
        o.min_trunk_radius_m,
        {.help = "radius of the thinnest trunk", .min = 0.02, .max = 2});
  visit("max_trunk_radius_m",
        o.max_trunk_radius_m,
        {.help = "radius of the thickest trunk", .min = 0.02, .max = 2});
  visit("lonely_share",
        o.lonely_share,
        {.help = "share of the way, round the sharp turn, on which few trees are in view",
         .min = 0,
         .max = 0.9});
  visit("lonely_in_view",
        o.lonely_in_view,
        {.help = "trees in view there, no more and hardly ever fewer", .min = 0, .max = 20});
  visit("usual_in_view",
        o.usual_in_view,
        {.help = "trees in view elsewhere; single ones are planted where groups do not suffice",
         .min = 0,
         .max = 20});
  visit("clearance_m",
        o.clearance_m,
        {.help = "no trunk is nearer to the way", .min = 0.5, .max = 6});
}

template <class Report>
void Validate(const ParkOptions& o, Report& report) {
  if (o.min_trunk_radius_m > o.max_trunk_radius_m) {
    report("min_trunk_radius_m", "must not exceed max_trunk_radius_m");
  }
}

/// Makes a park with one clockwise loop from the bottom-right corner, with a sharp turn in the
/// upper-right one, round which trees are few. Places and trunks change with the random numbers.
Place MakePark(const ParkOptions& options, RandomEngine& random);

}  // namespace sim
