// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "service/apps/command.hpp"

namespace qwsm::apps {

/// The arguments of a program's main().
struct Arguments {
  int count;
  const char* const* values;
};

/// Makes a program without commands, with the help, version and errors that all of ours have.
std::unique_ptr<CLI::App> MakeProgram(const std::string& help, const std::string& name);

/// Parses the arguments and runs the command they name. Whatever goes wrong becomes a message on
/// stderr and an exit code.
ExitCode RunProgram(CLI::App& program,
                    const std::vector<Command>& commands,
                    const Arguments& arguments);

}  // namespace qwsm::apps
