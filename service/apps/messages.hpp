// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/apps/command.hpp"

namespace qwsm::apps {

/// Sends messages (spdlog) to stderr, as much as was asked for, as `program: message`.
void StartMessages(const Verbosity& verbosity);

/// From this call on, messages are objects of JSON, one a line, each with its time and level: for
/// programs that collect what daemons say.
void WriteMessagesAsJson();

/// From this call on, all messages go to this file too, each with its time.
void CopyMessagesTo(const std::filesystem::path& file);

}  // namespace qwsm::apps
