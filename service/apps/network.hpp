// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/apps/network_session.hpp"
#include "service/options/program_options.hpp"

namespace qwsm::apps {

/// The network session of the program qwsm.
using NetworkSession = BasicNetworkSession<options::ProgramOptions>;

}  // namespace qwsm::apps
