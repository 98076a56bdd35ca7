// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/team/map/map_sharing.hpp"
#include "service/team/service/service_options.hpp"

namespace qwsm::team {

/// Options of a service for a team of robots with laser scanners.
struct TeamOptions : ServiceOptions {
  MapSharing map = MapSharing::kTeam;
  double teammate_radius_m = 0.7;
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
}

}  // namespace qwsm::team
