// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/leaf_pool.hpp"

#include <algorithm>
#include <cassert>
#include <memory>

namespace qwsm::quadtree {

std::uint32_t LeafPool::Add(const Square& square, std::uint32_t parent, int points) {
  const int blocks = std::max(1, (points + kBlockSize - 1) / kBlockSize);
  assert(blocks <= kMostBlocks);
  std::vector<std::uint32_t>& free = FreeOf(blocks);
  std::uint32_t i = 0;
  if (free.empty()) {
    i = Cut(PiecesOf(blocks));
  } else {
    i = free.back();
    free.pop_back();
  }
  std::construct_at(&(*this)[i],
                    Leaf{.corner = square.corner,
                         .parent = parent,
                         .level = static_cast<std::uint8_t>(square.level),
                         .blocks = static_cast<std::uint8_t>(blocks)});
  std::uninitialized_default_construct_n(&(*this)[i].block(0), blocks);
  ++size_;
  return i;
}

/// Pieces never used before, side by side in one page.
std::uint32_t LeafPool::Cut(std::uint32_t pieces) {
  if (end_ + pieces > pieces_.size()) {
    end_ = static_cast<std::uint32_t>(pieces_.size());  // What is left of a page is left.
    pieces_.Grow();
  }
  const std::uint32_t first = end_;
  end_ += pieces;
  return first;
}

void LeafPool::Free(std::uint32_t i) {
  FreeOf((*this)[i].blocks).push_back(i);
  --size_;
}

std::size_t LeafPool::bytes() const {
  std::size_t bytes = pieces_.bytes();
  for (const auto& free : free_) bytes += free.capacity() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace qwsm::quadtree
