// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "qwsm/search/detail/quadtree_layout.hpp"

namespace qwsm {

/// A stored point: dense, stable while the point is stored, used again only after its removal.
using PointId = std::uint32_t;

/// What a query remembers for its next search (Nuechter et al. 2007, section 4.1). A default one
/// remembers nothing. It may be copied: the cursor of the neighbouring beam is a fair start.
struct SearchCursor {
  std::uint64_t revision = 0;               ///< Revision of the tree that was searched; 0 is none.
  std::uint32_t leaf = quadtree::kNoIndex;  ///< Leaf of the neighbour; kNoIndex if none was found.
  PointId id = 0;                           ///< The neighbour.
  quadtree::UnitPoint neighbor{};           ///< Where the neighbour is.
  quadtree::UnitPoint query{};              ///< Where the query was.
  double clearance_of_point = 0.0;          ///< No other point was nearer than this, in units.
};

namespace quadtree {

/// Number of a state of a tree. No two states of any trees share one, so that a cursor is never
/// used with a tree it was not made by.
class Revision {
 public:
  Revision();
  Revision(const Revision&) : Revision() {}
  Revision(Revision&&) noexcept = default;
  Revision& operator=(const Revision&) { return *this = Revision(); }
  Revision& operator=(Revision&&) noexcept = default;
  ~Revision() = default;

  void Advance() { ++value_; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_;
};

}  // namespace quadtree
}  // namespace qwsm
