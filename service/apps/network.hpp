// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "service/apps/command.hpp"
#include "service/config/program_options.hpp"

namespace qwsm::dds {
class MiddlewareMessages;
}

namespace qwsm::apps {

/// Arguments of all commands that use the network.
struct NetworkArguments {
  config::OptionSources sources;
  Verbosity verbosity;
};

void AddNetworkArguments(CLI::App& parser,
                         NetworkArguments& arguments,
                         const std::string& json_help);

/// The options; from here on what the middleware has to say becomes messages.
class NetworkSession {
 public:
  explicit NetworkSession(const NetworkArguments& arguments);
  ~NetworkSession();

  const config::ProgramOptions& options() const { return options_; }

 private:
  config::ProgramOptions options_;
  std::unique_ptr<dds::MiddlewareMessages> messages_;
};

}  // namespace qwsm::apps
