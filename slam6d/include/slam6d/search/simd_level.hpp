// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace slam6d {

/// Says which instructions the searches use. They are chosen while running; every level gives the
/// same bits.
enum class SimdLevel {
  kPortable,  ///< Instructions that every machine the program is built for has.
  kAvx2,
  kAvx512,
  kBest,  ///< The best instructions the machine has.
};

inline std::span<const std::pair<std::string_view, SimdLevel>> Names(SimdLevel) {
  static constexpr std::array<std::pair<std::string_view, SimdLevel>, 4> kNames{{
      {"portable", SimdLevel::kPortable},
      {"avx2", SimdLevel::kAvx2},
      {"avx512", SimdLevel::kAvx512},
      {"best", SimdLevel::kBest},
  }};
  return kNames;
}

/// The level really used on this machine when `wanted` is asked for: never one it does not have.
SimdLevel AvailableSimd(SimdLevel wanted);

}  // namespace slam6d
