// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace qwsm::apps {

/// Writes to standard output, at once. @throws io::WriteError where not all of it gets there: a
/// result that nobody has got is none.
void PrintText(std::string_view text);

/// Formats text and writes it to standard output, as PrintText() does.
template <class... Values>
void Print(fmt::format_string<Values...> format, Values&&... values) {
  PrintText(fmt::format(format, std::forward<Values>(values)...));
}

}  // namespace qwsm::apps
