// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/local_submap.hpp"
#include "qwsm/mapping/motion_model.hpp"
#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// Says what a scan is matched with, and how.
enum class MatcherKind {
  kQWsm,  ///< Weighted, against the quadtree of all relevant scans (Visser et al. 2009).
  /// Weighted, against the last relevant scan only: the incremental WSM of Visser et al. (2009).
  kWsm,
  kIcp,  ///< Plain point-to-point ICP against the last relevant scan.
};

inline std::span<const std::pair<std::string_view, MatcherKind>> Names(MatcherKind) {
  static constexpr std::array<std::pair<std::string_view, MatcherKind>, 3> kNames = {{
      {"q-wsm", MatcherKind::kQWsm},
      {"wsm", MatcherKind::kWsm},
      {"icp", MatcherKind::kIcp},
  }};
  return kNames;
}

struct MapperOptions {
  MatcherKind matcher = MatcherKind::kQWsm;
  MotionNoise motion;
  ScanLocatorOptions locator;
  ScanMapOptions map;
  LocalSubmapOptions submap;
  FreeSpaceOptions free_space;
  double relevant_translation_m = 0.5;
  double relevant_rotation_rad = 0.35;
  double extended_below_overlap = 0.6;
  double match_floor_m = 0.0002;
  double match_floor_rad = 0.00005;
  bool extend_map = true;
};

template <class Visitor>
void Describe(Visitor& visit, MapperOptions& o) {
  visit("matcher", o.matcher, {.help = "q-wsm: all relevant scans; wsm, icp: the last one"});
  visit("motion", o.motion, {.help = "errors of odometry"});
  visit("locator", o.locator, {.help = "finding a scan in the map"});
  visit("map", o.map, {.help = "what is stored of relevant scans"});
  visit("submap",
        o.submap,
        {.help = "the last scans, by which loop closures are recognised",
         .formerly = "surroundings"});
  visit("free_space", o.free_space, {.help = "telling what moves by the free space seen before"});
  visit("relevant_translation_m",
        o.relevant_translation_m,
        {.help = "a scan is relevant when the robot moved this far since the last one",
         .min = 0,
         .max = 100});
  visit("relevant_rotation_rad",
        o.relevant_rotation_rad,
        {.help = "a scan is relevant when the robot turned this far since the last one",
         .min = 0,
         .max = 3.2});
  visit("extended_below_overlap",
        o.extended_below_overlap,
        {.help = "a match of less of the scan is told as 'extended'; odometry does not adapt to it",
         .formerly = "extend_below_overlap",
         .min = 0,
         .max = 1});
  visit("match_floor_m",
        o.match_floor_m,
        {.help = "sigma that no match of a position goes below", .min = 0, .max = 1});
  visit("match_floor_rad",
        o.match_floor_rad,
        {.help = "sigma that no match of a heading goes below", .min = 0, .max = 1});
  visit("extend_map", o.extend_map, {.help = "false: only localize in the map as it is"});
}

}  // namespace qwsm
