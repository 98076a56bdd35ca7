// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>

namespace qwsm::test {

/// Options of every kind, for tests of their files.
enum class Drive { kSkid, kDifferential };

inline std::span<const std::pair<std::string_view, Drive>> Names(Drive) {
  static constexpr std::array<std::pair<std::string_view, Drive>, 2> kNames{
      {{"skid", Drive::kSkid}, {"differential", Drive::kDifferential}}};
  return kNames;
}

struct LaserOptions {
  double range_min_m = 0.1;
  double range_max_m = 30.0;
  double field_of_view_rad = std::numbers::pi;
};

template <class Visitor>
void Describe(Visitor& visit, LaserOptions& o) {
  visit("range_min_m", o.range_min_m, {.help = "readings below are dropped", .min = 0.0});
  visit("range_max_m",
        o.range_max_m,
        {.help = "readings above are misses", .formerly = "reach_m", .max = 1000.0});
  visit("field_of_view_rad",
        o.field_of_view_rad,
        {.help = "of one sweep", .min = 0.0, .max = 2.0 * std::numbers::pi});
}

template <class Report>
void Validate(const LaserOptions& o, Report& report) {
  if (o.range_min_m >= o.range_max_m) report("range_min_m", "must be below range_max_m");
}

struct RobotOptions {
  int max_iterations = 40;
  bool verbose = false;
  Drive drive = Drive::kSkid;
  LaserOptions laser;
};

template <class Visitor>
void Describe(Visitor& visit, RobotOptions& o) {
  visit("max_iterations", o.max_iterations, {.help = "upper bound", .min = 1, .max = 1000});
  visit("verbose", o.verbose, {.help = "say more"});
  visit("drive", o.drive, {.help = "how it is pushed"});
  visit("laser", o.laser, {.help = "the front scanner", .formerly = "scanner"});
}

}  // namespace qwsm::test
