// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "service/team/service/team_options.hpp"
#include "slam6d/cloud/reduction.hpp"

namespace qwsm::team {

/// A service for robots with 3D scanners.
struct CloudTeamOptions {
  std::string service = "slam6d";
  std::vector<RobotStartOptions> robots;
  SessionOptions session;
  int threads = 0;
  double map_period_s = 2.0;
  slam6d::ReductionOptions map{.voxel_m = 0.1};
  double status_period_s = 1.0;
};

template <class Visitor>
void Describe(Visitor& visit, CloudTeamOptions& o) {
  visit("service", o.service, {.help = "name of this service in its reports"});
  visit("robots", o.robots, {.help = "where robots start"});
  visit("session", o.session, {.help = "how each robot is listened to"});
  visit(
      "threads",
      o.threads,
      {.help = "that register scans; 0: as many as the computer has cores", .min = 0, .max = 256});
  visit("map_period_s",
        o.map_period_s,
        {.help = "between merged clouds, where there is anything new; 0: none",
         .min = 0,
         .max = 3600});
  visit("map", o.map, {.help = "thinning of the merged cloud that is published"});
  visit("status_period_s",
        o.status_period_s,
        {.help = "between reports of the state", .min = 0.1, .max = 3600});
}

template <class Report>
void Validate(const CloudTeamOptions& o, Report& report) {
  if (o.service.empty()) report("service", "must not be empty");
}

}  // namespace qwsm::team
