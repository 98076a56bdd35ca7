// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Inside of PointQuadtree: positions and nodes.
namespace qwsm::quadtree {

/// Positions are fixed-point numbers: whole smallest cells, counted from the corner of the largest
/// square, and this many bits of a cell. One `unit` is 2^-10 cell, about a micrometre.
inline constexpr int kFractionBits = 10;
inline constexpr double kUnitsPerCell = 1 << kFractionBits;

/// Side of the largest square: 2^32 cells, 4295 km for cells of a millimetre.
inline constexpr int kMaxLevel = 32;
/// Positions in a leaf are 32-bit offsets in units, which limits its side: 2^21 cells, 2 km.
inline constexpr int kMaxLeafLevel = 31 - kFractionBits;

/// Points of a leaf that lie side by side in memory, so that they are compared at a time.
inline constexpr int kBlockSize = 4;
inline constexpr int kMostBlocks = 5;
/// Most points of a leaf.
inline constexpr int kBucketSize = kMostBlocks * kBlockSize;

inline constexpr std::uint32_t kNoIndex = ~0U;

/// Smallest cell, counted from the corner of the largest square.
struct Cell {
  std::uint32_t x = 0;
  std::uint32_t y = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Position of a stored point.
struct FixedPoint {
  Cell cell;
  std::uint16_t fraction_x = 0;  ///< In units from the cell's corner.
  std::uint16_t fraction_y = 0;
};

/// Any position, in units from the corner of the largest square.
struct UnitPoint {
  double x = 0.0;
  double y = 0.0;
};

inline UnitPoint ToUnitPoint(const FixedPoint& p) {
  return {p.cell.x * kUnitsPerCell + p.fraction_x, p.cell.y * kUnitsPerCell + p.fraction_y};
}

/// Square of 2^level by 2^level smallest cells, its corner a multiple of its side.
struct Square {
  Cell corner;
  int level = 0;

  std::uint64_t side() const { return std::uint64_t{1} << level; }

  bool Contains(Cell cell) const {
    return std::uint64_t{(cell.x ^ corner.x) | (cell.y ^ corner.y)} >> level == 0;
  }

  /// Which quarter holds the cell: bit 0 says right, bit 1 upper half. @pre level > 0
  unsigned QuarterOf(Cell cell) const {
    return ((cell.x >> (level - 1)) & 1U) | (((cell.y >> (level - 1)) & 1U) << 1);
  }

  /// @pre level > 0
  Square Quarter(unsigned quarter) const {
    const auto half = static_cast<std::uint32_t>(side() / 2);
    return {{corner.x + (quarter & 1U) * half, corner.y + (quarter >> 1) * half}, level - 1};
  }

  /// The square of a higher level around this one.
  Square AtLevel(int higher_level) const {
    const auto mask = static_cast<std::uint32_t>(~((std::uint64_t{1} << higher_level) - 1));
    return {{corner.x & mask, corner.y & mask}, higher_level};
  }
};

/// A leaf, an inner node, or none, in 32 bits.
class NodeRef {
 public:
  constexpr NodeRef() = default;
  static constexpr NodeRef Leaf(std::uint32_t index) { return NodeRef(index | kLeafBit); }
  static constexpr NodeRef Inner(std::uint32_t index) { return NodeRef(index); }

  constexpr explicit operator bool() const { return bits_ != kNone; }
  constexpr bool is_leaf() const { return (bits_ & kLeafBit) != 0; }  ///< @pre not none
  constexpr bool is_inner() const { return (bits_ & kLeafBit) == 0; }
  constexpr std::uint32_t index() const { return bits_ & ~kLeafBit; }

  friend bool operator==(const NodeRef&, const NodeRef&) = default;

 private:
  static constexpr std::uint32_t kLeafBit = 1U << 31;
  static constexpr std::uint32_t kNone = ~0U;
  constexpr explicit NodeRef(std::uint32_t bits) : bits_(bits) {}

  std::uint32_t bits_ = kNone;
};

struct InnerNode {
  std::array<NodeRef, 4> children;  ///< By quarter; none where there is no point.
  std::uint32_t parent = kNoIndex;  ///< Inner node; kNoIndex at the root.
};

/// Points side by side. Behind the last one of a leaf there is anything.
struct Block {
  std::array<std::int32_t, kBlockSize> x{};  ///< Offset from the leaf's corner, in units.
  std::array<std::int32_t, kBlockSize> y{};
  std::array<std::uint32_t, kBlockSize> id{};
};

/// Up to kBucketSize points. In memory its blocks follow, as many as the points need: a leaf of
/// four points fills a cache line, one of twenty four of them. LeafPool makes them.
struct Leaf {
  Cell corner;
  std::uint32_t parent = kNoIndex;  ///< Inner node; kNoIndex if the leaf is the root.
  std::uint8_t level = 0;
  std::uint8_t blocks = 0;
  std::uint16_t count = 0;  ///< Of points.

  Square square() const { return {corner, level}; }
  int room() const { return blocks * kBlockSize; }

  Block& block(int i) { return reinterpret_cast<Block*>(this + 1)[i]; }
  const Block& block(int i) const { return reinterpret_cast<const Block*>(this + 1)[i]; }
  // Of the i-th point.
  std::int32_t& x(int i) { return block(BlockOf(i)).x[LaneOf(i)]; }
  std::int32_t& y(int i) { return block(BlockOf(i)).y[LaneOf(i)]; }
  std::uint32_t& id(int i) { return block(BlockOf(i)).id[LaneOf(i)]; }
  std::int32_t x(int i) const { return block(BlockOf(i)).x[LaneOf(i)]; }
  std::int32_t y(int i) const { return block(BlockOf(i)).y[LaneOf(i)]; }
  std::uint32_t id(int i) const { return block(BlockOf(i)).id[LaneOf(i)]; }

 private:
  static constexpr int BlockOf(int i) {
    return static_cast<int>(static_cast<unsigned>(i) / kBlockSize);
  }
  static constexpr std::size_t LaneOf(int i) { return static_cast<unsigned>(i) % kBlockSize; }
};
static_assert(sizeof(Leaf) == 16 && sizeof(Block) == 48);

}  // namespace qwsm::quadtree
