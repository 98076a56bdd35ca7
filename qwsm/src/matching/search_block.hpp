// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {

// Level of the blocks that a search begins with.
inline constexpr int kRootLevel = LikelihoodPyramid::kLevels - 1;
inline constexpr int kRootSide = 1 << LikelihoodTile::ShiftOf(kRootLevel);
// So many finer blocks are in each, along each axis.
inline constexpr int kBlocksOfRoot = kRootSide / LikelihoodWindow::kBlockSide;

// A square block of cell offsets at one heading.
struct SearchBlock {
  double bound = 0.0;
  int heading = 0;
  int x = 0;
  int y = 0;
  int side = 1;  // In cells.

  bool operator<(const SearchBlock& other) const { return bound < other.bound; }
};

// Offsets -reach .. reach in x and y.
struct OffsetRange {
  explicit OffsetRange(int reach_cells) : reach(reach_cells) {}

  // Whether all can be tried at once.
  bool IsOneBlock() const { return LikelihoodWindow::kBlockSide > 2 * reach; }

  int first() const { return -reach; }
  // Last cell of the blocks that cover them.
  int last() const {
    const int side = IsOneBlock() ? LikelihoodWindow::kBlockSide : kRootSide;
    return first() + (2 * reach / side + 1) * side - 1;
  }

  int reach;
};

}  // namespace qwsm
