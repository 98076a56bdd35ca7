// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <spdlog/spdlog.h>

#include <string>

#include "service/apps/messages.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/dds/middleware_messages.hpp"
#include "service/pipeline/slam6d/program_options.hpp"

namespace slam6d::apps {

/// Arguments of all commands that use the network.
struct NetworkArguments {
  qwsm::config::OptionSources sources;
  qwsm::apps::Verbosity verbosity;
};

inline void AddNetworkArguments(CLI::App& parser, NetworkArguments& arguments) {
  qwsm::apps::AddConfiguration(parser, arguments.sources);
  qwsm::apps::AddVerbosity(parser, arguments.verbosity, "not used");
}

/// The options; from here on what the middleware has to say becomes messages.
class NetworkSession {
 public:
  explicit NetworkSession(const NetworkArguments& arguments)
      : options_(Begin(arguments)),
        messages_([](const std::string& text) { spdlog::warn("{}", text); }) {}

  const pipeline::ProgramOptions& options() const { return options_; }

 private:
  static pipeline::ProgramOptions Begin(const NetworkArguments& arguments) {
    qwsm::apps::StartMessages(arguments.verbosity);
    return qwsm::config::LoadOptions<pipeline::ProgramOptions>(arguments.sources);
  }

  pipeline::ProgramOptions options_;
  qwsm::dds::MiddlewareMessages messages_;
};

}  // namespace slam6d::apps
