// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/network_session.hpp"

namespace qwsm::apps {

void AddNetworkArguments(CLI::App& parser,
                         NetworkArguments& arguments,
                         const std::string& json_help) {
  AddConfiguration(parser, arguments.sources);
  AddVerbosity(parser, arguments.verbosity, json_help);
}

}  // namespace qwsm::apps
