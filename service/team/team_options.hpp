// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace qwsm::team {

/// Who matches against what.
enum class MapSharing {
  kTeam,       ///< All robots against one map.
  kEachRobot,  ///< Each against its own.
};

inline std::span<const std::pair<std::string_view, MapSharing>> Names(MapSharing) {
  static constexpr std::array<std::pair<std::string_view, MapSharing>, 2> kNames = {{
      {"team", MapSharing::kTeam},
      {"each-robot", MapSharing::kEachRobot},
  }};
  return kNames;
}

/// Where a robot starts in the map.
struct RobotStartOptions {
  std::string name = "robot1";
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double sigma_m = 0.1;
  double sigma_rad = 0.05;
};

template <class Visitor>
void Describe(Visitor& visit, RobotStartOptions& o) {
  visit("name", o.name, {.help = "of the robot: its namespace"});
  visit("x_m", o.x_m, {.help = "where it starts", .min = -1e4, .max = 1e4});
  visit("y_m", o.y_m, {.help = "where it starts", .min = -1e4, .max = 1e4});
  visit("heading_rad", o.heading_rad, {.help = "heading at the start", .min = -7, .max = 7});
  visit("sigma_m", o.sigma_m, {.help = "how far off that may be", .min = 0, .max = 10});
  visit("sigma_rad", o.sigma_rad, {.help = "and how far the heading", .min = 0, .max = 3.2});
}

/// How one robot is listened to.
struct SessionOptions {
  int queue_scans = 4;
  double odometry_wait_s = 0.05;
  double max_speed_mps = 5.0;
  double max_turn_rate_radps = 10.0;
};

template <class Visitor>
void Describe(Visitor& visit, SessionOptions& o) {
  visit("queue_scans",
        o.queue_scans,
        {.help = "scans of a robot that may wait; then the oldest is dropped",
         .min = 1,
         .max = 100000});
  visit("odometry_wait_s",
        o.odometry_wait_s,
        {.help = "how long a scan waits for the odometry of its moment", .min = 0, .max = 10});
  visit("max_speed_mps",
        o.max_speed_mps,
        {.help = "odometry that moves faster has jumped", .min = 0.01, .max = 1000});
  visit("max_turn_rate_radps",
        o.max_turn_rate_radps,
        {.help = "or turns faster", .min = 0.01, .max = 1000});
}

/// A service for a team of robots.
struct TeamOptions {
  std::string service = "qwsm";
  MapSharing map = MapSharing::kTeam;
  std::vector<RobotStartOptions> robots;
  SessionOptions session;
  double teammate_radius_m = 0.7;
  int threads = 0;
  double map_period_s = 5.0;
  double status_period_s = 1.0;
};

template <class Visitor>
void Describe(Visitor& visit, TeamOptions& o) {
  visit("service", o.service, {.help = "name of this service among those of the team"});
  visit("map", o.map, {.help = "team: one map for all; each-robot: one each"});
  visit("robots", o.robots, {.help = "where robots start"});
  visit("session", o.session, {.help = "how each robot is listened to"});
  visit("teammate_radius_m",
        o.teammate_radius_m,
        {.help = "what is seen this near to another robot of the map is that robot",
         .min = 0,
         .max = 100});
  visit("threads",
        o.threads,
        {.help = "that match scans; 0: as many as the computer has cores", .min = 0, .max = 256});
  visit("map_period_s",
        o.map_period_s,
        {.help = "between pictures of the map; 0: none", .min = 0, .max = 3600});
  visit("status_period_s",
        o.status_period_s,
        {.help = "between reports of the state", .min = 0.1, .max = 3600});
}

template <class Report>
void Validate(const TeamOptions& o, Report& report) {
  if (o.service.empty()) report("service", "must not be empty");
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < o.robots.size(); ++i) {
    const std::string key = "robots[" + std::to_string(i) + "].name";
    if (o.robots[i].name.empty()) report(key, "must not be empty");
    if (!names.insert(o.robots[i].name).second) report(key, "is the name of another robot, too");
  }
}

}  // namespace qwsm::team
