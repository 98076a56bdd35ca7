// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/text/messages.hpp"

#include <spdlog/spdlog.h>

namespace qwsm::messages {

void Info(std::string_view text) { spdlog::info(text); }
void Warn(std::string_view text) { spdlog::warn(text); }
void Error(std::string_view text) { spdlog::error(text); }

}  // namespace qwsm::messages
