// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace qwsm::io {

/// One relevant scan as it is kept: who took it, and its contents in a form the journal does not
/// look into.
struct JournalEntry {
  std::string service;
  std::string robot;
  std::uint64_t sequence = 0;
  std::chrono::nanoseconds stamp{};
  std::string contents;
};

}  // namespace qwsm::io
