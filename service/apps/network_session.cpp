// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/network.hpp"

#include <spdlog/spdlog.h>

#include "service/apps/messages.hpp"
#include "service/dds/middleware_messages.hpp"

namespace qwsm::apps {

void AddNetworkArguments(CLI::App& parser,
                         NetworkArguments& arguments,
                         const std::string& json_help) {
  AddConfiguration(parser, arguments.sources);
  AddVerbosity(parser, arguments.verbosity, json_help);
}

NetworkSession::NetworkSession(const NetworkArguments& arguments) {
  StartMessages(arguments.verbosity);
  options_ = config::LoadOptions<config::ProgramOptions>(arguments.sources);
  messages_ = std::make_unique<dds::MiddlewareMessages>(
      [](const std::string& text) { spdlog::warn("{}", text); });
}

NetworkSession::~NetworkSession() = default;

}  // namespace qwsm::apps
