// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/entities/network_options.hpp"
#include "service/options/slam6d/registration_options.hpp"
#include "service/options/slam6d/simulation_options.hpp"
#include "service/team/service/cloud_options.hpp"
#include "service/view/view_options.hpp"

namespace slam6d::options {

/// All options of the program `slam6d`.
struct ProgramOptions : RegistrationOptions {
  qwsm::dds::NetworkOptions network{.interface = {}, .tag = {}, .node = "slam6d"};
  qwsm::team::CloudTeamOptions team{};
  SimulationOptions sim{};
  qwsm::view::ViewOptions view{};
};

template <class Visitor>
void Describe(Visitor& visit, ProgramOptions& o) {
  Describe(visit, static_cast<RegistrationOptions&>(o));
  visit("network", o.network, {.help = "DDS, by which robots and services talk"});
  visit("team", o.team, {.help = "the service for robots on the network"});
  visit("view", o.view, {.help = "the page of 'slam6d serve --view'"});
  visit("sim", o.sim, {.help = "what `slam6d sim` makes of a scenario of the plane"});
}

}  // namespace slam6d::options
