// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

/// What the programs tell people while they run; where it goes is decided in service/apps.
///
/// The text is formatted here and only passed on to spdlog: sources that call spdlog with arguments
/// compile the whole of fmt each.
namespace qwsm::messages {

void Info(std::string_view text);
void Warn(std::string_view text);
void Error(std::string_view text);

template <class First, class... Others>
void Info(fmt::format_string<First, Others...> format, First&& first, Others&&... others) {
  Info(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...));
}

template <class First, class... Others>
void Warn(fmt::format_string<First, Others...> format, First&& first, Others&&... others) {
  Warn(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...));
}

template <class First, class... Others>
void Error(fmt::format_string<First, Others...> format, First&& first, Others&&... others) {
  Error(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...));
}

}  // namespace qwsm::messages
