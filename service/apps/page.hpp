// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "service/apps/command.hpp"
#include "service/pipeline/run/interruption.hpp"

namespace qwsm::apps {

/// Adds the flag --view. @returns it.
CLI::Option* AddViewFlag(CLI::App& parser, bool& is_wanted);

/// Tells where the live page is: as a message, and on standard output if a person reads that.
void TellPage(const std::string& url, bool is_output_for_people);

/// Leaves the page there until Ctrl-C, if a person sits in front of the program.
/// @param stay returns when the interruption is requested.
void KeepPage(const std::function<void(const pipeline::Interruption&)>& stay);

}  // namespace qwsm::apps
