// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>

namespace qwsm::io {

/// A name of one of a series, as scan007, and the number at its end.
struct NumberedName {
  std::string name;    ///< What stands before the number.
  std::string digits;  ///< Of the number, without zeros before it: empty for 0, too.
  bool has_number = false;

  static NumberedName Of(const std::string& name);

  /// The number, if there is one that 64 bits hold.
  std::optional<std::uint64_t> Number() const;
  /// Brings names in the order of their numbers: scan9 before scan10.
  auto Order() const { return std::tuple(name, digits.size(), digits); }
};

}  // namespace qwsm::io
