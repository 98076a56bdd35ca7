// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/config/loader.hpp"
#include "service/dds/entities/middleware_messages.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {

/// Arguments of all commands that use the network.
struct NetworkArguments {
  config::OptionSources sources;
  Verbosity verbosity;
};

void AddNetworkArguments(CLI::App& parser,
                         NetworkArguments& arguments,
                         const std::string& json_help);

/// Holds the options of a program; while it lives, what the middleware has to say becomes messages.
template <class Options>
class BasicNetworkSession {
 public:
  explicit BasicNetworkSession(const NetworkArguments& arguments)
      : options_(Begin(arguments)),
        messages_([](const std::string& text) { messages::Warn(text); }) {}

  const Options& options() const { return options_; }

 private:
  static Options Begin(const NetworkArguments& arguments) {
    StartMessages(arguments.verbosity);
    return config::LoadOptions<Options>(arguments.sources);
  }

  Options options_;
  dds::MiddlewareMessages messages_;
};

}  // namespace qwsm::apps
