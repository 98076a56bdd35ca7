// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "qwsm/search/detail/paged_pool.hpp"
#include "qwsm/search/detail/quadtree_layout.hpp"

namespace qwsm::quadtree {

/// Leaves, each with as many blocks as it was made for. Indices count pieces of 16 bytes; those of
/// freed leaves are handed out again to leaves of the same size. Nothing is ever moved.
class LeafPool {
 public:
  Leaf& operator[](std::uint32_t i) { return reinterpret_cast<Leaf&>(pieces_[i]); }
  const Leaf& operator[](std::uint32_t i) const {
    return reinterpret_cast<const Leaf&>(pieces_[i]);
  }

  /// Makes a leaf without points and returns its index. Invalidates no reference.
  /// @param points how many it has room for, at least.
  std::uint32_t Add(const Square& square, std::uint32_t parent, int points);
  /// @pre `i` was given by Add() and not freed since.
  void Free(std::uint32_t i);

  /// Leaves in use.
  std::size_t size() const { return size_; }
  /// Memory held.
  std::size_t bytes() const;

 private:
  struct alignas(16) Piece {
    std::array<std::byte, 16> bytes;
  };
  static_assert(sizeof(Leaf) == sizeof(Piece) && sizeof(Block) % sizeof(Piece) == 0);

  static constexpr std::uint32_t PiecesOf(int blocks) {
    return static_cast<std::uint32_t>(
        (sizeof(Leaf) + static_cast<std::size_t>(blocks) * sizeof(Block)) / sizeof(Piece));
  }
  std::vector<std::uint32_t>& FreeOf(int blocks) {
    return free_[static_cast<std::size_t>(blocks - 1)];
  }
  std::uint32_t Cut(std::uint32_t pieces);

  Pages<Piece, 10> pieces_;
  std::uint32_t end_ = 0;  ///< Pieces from here on were never used.
  std::array<std::vector<std::uint32_t>, kMostBlocks> free_;  ///< By blocks, from one on.
  std::size_t size_ = 0;
};

}  // namespace qwsm::quadtree
