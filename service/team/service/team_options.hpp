// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "service/team/map/map_sharing.hpp"
#include "service/team/service/service_options.hpp"
#include "service/team/session/correction_options.hpp"

namespace qwsm::team {

/// Options of a service for a team of robots with laser scanners.
struct TeamOptions : ServiceOptions {
  MapSharing map = MapSharing::kTeam;
  double teammate_radius_m = 0.7;
  std::string scans = "scan";
  TeamCorrectionOptions correction{};
};

template <class Visitor>
void Describe(Visitor& visit, TeamOptions& o) {
  Describe(visit, static_cast<ServiceOptions&>(o));
  visit("map", o.map, {.help = "team: one map for all; each-robot: one each"});
  visit("teammate_radius_m",
        o.teammate_radius_m,
        {.help = "what is seen this near to another robot of the map is that robot",
         .min = 0,
         .max = 100});
  visit("scans",
        o.scans,
        {.help = "topics of a robot's lasers below its namespace, with commas: scan,rear/scan"});
  visit("correction", o.correction, {.help = "how corrections of the map reach the robots"});
}

/// The topics of a robot's lasers, as `rear/scan`.
inline std::vector<std::string> ScanTopicsOf(const TeamOptions& options) {
  std::vector<std::string> topics;
  std::istringstream list(options.scans);
  for (std::string topic; std::getline(list, topic, ',');) topics.push_back(topic);
  return topics;
}

template <class Report>
void Validate(const TeamOptions& o, Report& report) {
  Validate(static_cast<const ServiceOptions&>(o), report);
  const std::vector<std::string> topics = ScanTopicsOf(o);
  const auto is_wrong = [](const std::string& topic) {
    return topic.empty() || topic.starts_with('/') || topic.ends_with('/') ||
           topic.find(' ') != std::string::npos;
  };
  if (topics.empty() || std::ranges::any_of(topics, is_wrong)) {
    report("scans", "must be names below a robot's namespace, with commas: scan,rear/scan");
  }
}

}  // namespace qwsm::team
