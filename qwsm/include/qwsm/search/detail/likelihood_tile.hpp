// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace qwsm {

/// A square of a LikelihoodPyramid: its cells at both levels.
class LikelihoodTile {
 public:
  static constexpr int kLevels = 2;
  static constexpr std::uint8_t kUnmapped = std::numeric_limits<std::uint8_t>::max();
  static constexpr std::uint8_t kMapped = 60;  ///< A cell counts as mapped by a point from here on.
  static constexpr int kBits = 5;
  static constexpr int kSide = 1 << kBits;  ///< Side of a tile, in cells of level 0.
  /// A cell of a level is 2^ShiftOf(level) cells of level 0 wide.
  static constexpr int ShiftOf(int level) { return level == 0 ? 0 : 2; }
  /// A cell of drift of a level is 2^DriftShiftOf(level) cells of level 0 wide: drift need not be
  /// known as finely as likelihood.
  static constexpr int DriftShiftOf(int level) { return level == 0 ? 1 : 4; }

  LikelihoodTile() { drift_codes_.fill(kUnmapped); }

  /// Likelihoods of a level, one row after the other. Empty cells hold 0.
  const std::uint8_t* likelihoods(int level) const { return &likelihoods_[FirstOf(level)]; }
  std::uint8_t* likelihoods(int level) { return &likelihoods_[FirstOf(level)]; }
  /// Drift codes of a level, one row after the other. Empty cells hold kUnmapped.
  const std::uint8_t* drift_codes(int level) const { return &drift_codes_[FirstDriftOf(level)]; }
  std::uint8_t* drift_codes(int level) { return &drift_codes_[FirstDriftOf(level)]; }

 private:
  // First cell of each level, and the number of all cells.
  static constexpr std::array<std::size_t, kLevels + 1> kFirst = {0, 1024, 1088};
  static constexpr std::array<std::size_t, kLevels + 1> kFirstDrift = {0, 256, 260};
  static std::size_t FirstOf(int level) { return kFirst[static_cast<std::size_t>(level)]; }
  static std::size_t FirstDriftOf(int level) {
    return kFirstDrift[static_cast<std::size_t>(level)];
  }

  std::array<std::uint8_t, kFirst.back()> likelihoods_{};
  std::array<std::uint8_t, kFirstDrift.back()> drift_codes_;
};

}  // namespace qwsm
