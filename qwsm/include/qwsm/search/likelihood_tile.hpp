// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace qwsm {

/// A cell of a LikelihoodPyramid; of level 0 where nothing else is said.
struct GridCell {
  int x = 0;
  int y = 0;
};

/// A square of a LikelihoodPyramid: its cells at every level.
class LikelihoodTile {
 public:
  static constexpr int kLevels = 5;
  static constexpr int kFirstDriftLevel = 1;  ///< Drift need not be known more finely.
  static constexpr std::uint8_t kUnmapped = std::numeric_limits<std::uint8_t>::max();
  static constexpr int kBits = 5;
  static constexpr int kSide = 1 << kBits;  ///< In cells of level 0.
  static constexpr int SideAt(int level) { return kSide >> level; }

  LikelihoodTile() { drift_codes_.fill(kUnmapped); }

  /// Cells of a level, SideAt(level) to a row, one row after the other. Empty ones hold 0.
  const std::uint8_t* likelihoods(int level) const { return &likelihoods_[CellsBelow(level)]; }
  std::uint8_t* likelihoods(int level) { return &likelihoods_[CellsBelow(level)]; }
  /// The same of drift codes. Empty ones hold kUnmapped. @pre level >= kFirstDriftLevel
  const std::uint8_t* drift_codes(int level) const {
    return &drift_codes_[CellsBelow(level) - kCellsWithoutDrift];
  }
  std::uint8_t* drift_codes(int level) {
    return &drift_codes_[CellsBelow(level) - kCellsWithoutDrift];
  }

 private:
  static constexpr std::size_t kCellsWithoutDrift = 1024;
  static constexpr std::size_t kCells = 1024 + 256 + 64 + 16 + 4;
  // Cells of the levels finer than this one: each level has a quarter of the one before.
  static constexpr std::size_t CellsBelow(int level) {
    constexpr std::size_t kFinest = std::size_t{kSide} * kSide;
    return (4 * kFinest - (4 * kFinest >> (2 * level))) / 3;
  }

  std::array<std::uint8_t, kCells> likelihoods_{};
  std::array<std::uint8_t, kCells - kCellsWithoutDrift> drift_codes_;
};

}  // namespace qwsm
