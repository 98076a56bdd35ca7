// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/apps/command.hpp"

namespace slam6d::apps {

using qwsm::apps::AddParser;
using qwsm::apps::Command;
using qwsm::apps::ExitCode;

// These add one command each to the program slam6d, and stand in a file each.
Command AddRegisterCommand(CLI::App& program);
Command AddSimCommand(CLI::App& program);
Command AddServeCommand(CLI::App& program);
Command AddReplayCommand(CLI::App& program);
Command AddEvalCommand(CLI::App& program);
Command AddBenchSearchCommand(CLI::App& program);
Command AddConfigCommand(CLI::App& program);

}  // namespace slam6d::apps
