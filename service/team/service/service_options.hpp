// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/scans/robot_name.hpp"
#include "service/team/session/session_options.hpp"

namespace qwsm::team {

/// Options of a service, whatever its robots' sensors are.
struct ServiceOptions {
  std::string service = "qwsm";
  std::vector<RobotStartOptions> robots{};
  SessionOptions session{};
  int threads = 0;
  double map_period_s = 5.0;
  double status_period_s = 1.0;
};

template <class Visitor>
void Describe(Visitor& visit, ServiceOptions& o) {
  visit("service", o.service, {.help = "name of this service among those of the team"});
  visit("robots", o.robots, {.help = "where robots start"});
  visit("session", o.session, {.help = "how each robot is listened to"});
  visit("threads",
        o.threads,
        {.help = "that match scans; 0: as many as the computer has cores", .min = 0, .max = 256});
  visit("map_period_s",
        o.map_period_s,
        {.help = "between maps that are published; 0: none", .min = 0, .max = 3600});
  visit("status_period_s",
        o.status_period_s,
        {.help = "between reports of the state", .min = 0.1, .max = 3600});
}

template <class Report>
void Validate(const ServiceOptions& o, Report& report) {
  if (o.service.empty()) report("service", "must not be empty");
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < o.robots.size(); ++i) {
    const std::string key = "robots[" + std::to_string(i) + "].name";
    if (o.robots[i].name.empty()) report(key, "must not be empty");
    if (!IsRobotName(o.robots[i].name)) {
      report(key, "must be a namespace of letters, digits, _ and / between them, such as robot1");
    }
    if (!names.insert(o.robots[i].name).second) report(key, "is the name of another robot, too");
  }
}

/// Where the robot is configured to start; null where it is not configured.
inline const RobotStartOptions* FindStart(const ServiceOptions& options, std::string_view robot) {
  const auto found = std::ranges::find(options.robots, robot, &RobotStartOptions::name);
  return found == options.robots.end() ? nullptr : &*found;
}

}  // namespace qwsm::team
