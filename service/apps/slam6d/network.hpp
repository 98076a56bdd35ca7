// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/apps/network_session.hpp"
#include "service/options/slam6d/program_options.hpp"

namespace slam6d::apps {

using qwsm::apps::AddNetworkArguments;
using qwsm::apps::NetworkArguments;

/// The network session of the program slam6d.
using NetworkSession = qwsm::apps::BasicNetworkSession<options::ProgramOptions>;

}  // namespace slam6d::apps
