// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

namespace qwsm::view {

using Clock = std::chrono::steady_clock;

/// A message of a channel. Copies share its bytes.
struct Sample {
  std::shared_ptr<const void> owner;
  std::string_view bytes;
  std::uint64_t stamp_ns = 0;  ///< When it was published, since 1970.
  Clock::time_point arrived{};
};

}  // namespace qwsm::view
