// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "beam_ends.hpp"
#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {

// Blocks of offsets side by side, which LikelihoodWindow bounds.
struct BlockRange {
  int column = 0;  // Of the first one.
  int row = 0;
  int columns = 1;
  int rows = 1;
};

// A square of cell offsets at some headings.
struct SearchBlock {
  double bound = 0.0;
  HeadingRange headings;
  GridCell first;  // Offset.
  int side = 1;    // In cells.
  // Of a root: the bounds of all beams, and which of their blocks are in it.
  std::span<const LikelihoodWindow::Bounds> beams{};
  BlockRange blocks{};

  bool operator<(const SearchBlock& other) const { return bound < other.bound; }
};

// Offsets from one on, in blocks.
struct OffsetArea {
  GridCell first;
  int columns = 0;
  int rows = 0;
};

}  // namespace qwsm
