// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/team/service/service_options.hpp"
#include "slam6d/cloud/reduction.hpp"

namespace qwsm::team {

/// Options of a service for robots with 3D scanners.
struct CloudTeamOptions : ServiceOptions {
  CloudTeamOptions()
      : ServiceOptions{
            .service = "slam6d", .session = {.max_readings = 1'000'000}, .map_period_s = 2.0} {}

  slam6d::ReductionOptions map{.voxel_m = 0.1};
};

template <class Visitor>
void Describe(Visitor& visit, CloudTeamOptions& o) {
  Describe(visit, static_cast<ServiceOptions&>(o));
  visit("map", o.map, {.help = "thinning of the merged cloud that is published"});
}

}  // namespace qwsm::team
