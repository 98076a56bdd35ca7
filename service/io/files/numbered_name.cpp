// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/numbered_name.hpp"

#include <algorithm>
#include <charconv>

namespace qwsm::io {

NumberedName NumberedName::Of(const std::string& name) {
  const std::size_t length = name.find_last_not_of("0123456789") + 1;
  const std::size_t first = std::min(name.find_first_not_of('0', length), name.size());
  return {.name = name.substr(0, length),
          .digits = name.substr(first),
          .has_number = length < name.size()};
}

std::optional<std::uint64_t> NumberedName::Number() const {
  if (!has_number) return std::nullopt;
  std::uint64_t number = 0;
  const char* const end = digits.data() + digits.size();
  const bool is_held =
      digits.empty() || std::from_chars(digits.data(), end, number).ec == std::errc{};
  return is_held ? std::optional(number) : std::nullopt;
}

}  // namespace qwsm::io
