// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qwsm::team {

/// Says when a robot that drives by `map` -> `odom` is told that the map was corrected.
enum class CorrectionPolicy {
  kNow,   ///< With the next scan.
  kRest,  ///< As soon as it stands.
  kSlew,  ///< Little by little.
};

inline std::span<const std::pair<std::string_view, CorrectionPolicy>> Names(CorrectionPolicy) {
  static constexpr std::array<std::pair<std::string_view, CorrectionPolicy>, 3> kNames = {{
      {"now", CorrectionPolicy::kNow},
      {"rest", CorrectionPolicy::kRest},
      {"slew", CorrectionPolicy::kSlew},
  }};
  return kNames;
}

/// How corrections of the map reach a robot.
struct CorrectionOptions {
  CorrectionPolicy policy = CorrectionPolicy::kNow;
  double slew_mps = 0.1;
};

template <class Visitor>
void Describe(Visitor& visit, CorrectionOptions& o) {
  visit("policy",
        o.policy,
        {.help = "when map -> odom follows a correction: now; rest: when the robot stands; slew: "
                 "little by little"});
  visit("slew_mps",
        o.slew_mps,
        {.help = "with slew: so much a second, in metres, or radians where it turns more",
         .min = 1e-3,
         .max = 100});
}

/// The same for one robot.
struct RobotCorrectionOptions : CorrectionOptions {
  std::string name = "robot1";
};

template <class Visitor>
void Describe(Visitor& visit, RobotCorrectionOptions& o) {
  visit("name", o.name, {.help = "of the robot: its namespace"});
  Describe(visit, static_cast<CorrectionOptions&>(o));
}

/// How corrections reach the robots of a team.
struct TeamCorrectionOptions : CorrectionOptions {
  std::vector<RobotCorrectionOptions> robots{};
};

template <class Visitor>
void Describe(Visitor& visit, TeamCorrectionOptions& o) {
  Describe(visit, static_cast<CorrectionOptions&>(o));
  visit("robots", o.robots, {.help = "those for which it is otherwise"});
}

template <class Report>
void Validate(const TeamCorrectionOptions& o, Report& report) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < o.robots.size(); ++i) {
    const std::string key = "robots[" + std::to_string(i) + "].name";
    if (o.robots[i].name.empty()) report(key, "must not be empty");
    if (!names.insert(o.robots[i].name).second) report(key, "is the name of another robot, too");
  }
}

/// How corrections reach a robot: as it is said for it, else as for all.
inline const CorrectionOptions& CorrectionOf(const TeamCorrectionOptions& options,
                                             std::string_view robot) {
  const auto found = std::ranges::find(options.robots, robot, &RobotCorrectionOptions::name);
  if (found != options.robots.end()) return *found;
  return options;
}

}  // namespace qwsm::team
