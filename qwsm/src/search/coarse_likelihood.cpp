// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/coarse_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "short_sums.hpp"

namespace qwsm {
namespace {

constexpr int kTileSide = LikelihoodTile::kSide;

// Raises the cells of a row to those of another one, as far as that has any; or to every second one
// of them.
void RaiseRow(std::span<std::uint8_t> row, std::span<const std::uint8_t> by, int stride) {
  const std::size_t count = std::min(row.size(), stride == 1 ? by.size() : (by.size() + 1) / 2);
  std::uint8_t* const to = row.data();  // Bytes may be anything, to the compiler sizes, too.
  const std::uint8_t* const from = by.data();
  if (stride == 1) {
    for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], from[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], from[2 * i]);
  }
}

// Cells of a plane, so many strides apart, that together reach as far as is wanted.
std::vector<int> PartsOf(int reach, int stride, int wanted_reach) {
  const int last = (wanted_reach - reach) / stride;
  std::vector<int> parts;
  for (int part = 0; part < last; part += reach / stride) parts.push_back(part);
  parts.push_back(last);
  return parts;
}

// Offsets of a square and beside it, to both sides, that points reach which move by so much of its
// width.
int SideOf(int level, double move) {
  const int width = CoarseLikelihood::WidthOf(level);
  return width + static_cast<int>(std::ceil(2.0 * move * width));
}

// So that four bytes may be read wherever there is one.
constexpr std::size_t kReadAhead = sizeof(std::uint32_t) - 1;

// Where a square of offsets is in a plane.
struct SquareInPlane {
  const std::uint8_t* cells;
  int width;       // Of the plane.
  int shift;       // Of the plane.
  GridCell first;  // Level-0 cell of the square.
  int next;        // So many cells on is the next square.

  const std::uint8_t* At(const GridCell& cell) const {
    const int x = (cell.x + first.x) >> shift;
    const int y = (cell.y + first.y) >> shift;
    return cells + y * width + x;
  }
};

// Sums over a scan at a square of offsets and at its neighbours.
class FourSums {
 public:
  FourSums(std::size_t points, double needed) : left_(kFull * static_cast<int>(points)) {
    full_ = left_;
    needed_ = static_cast<int>(needed * full_);
  }

  // Adds points until none of the sums can be as large as needed any more.
  void Add(std::span<const GridCell> points, const SquareInPlane& square) {
    constexpr std::size_t kAtOnce = 16;
    while (!points.empty() && MayReach()) {
      const auto next = points.first(std::min(points.size(), kAtOnce));
      points = points.subspan(next.size());
      left_ -= kFull * static_cast<int>(next.size());
      AddSome(next, square);
    }
  }

  CoarseLikelihood::FourBounds Means() const {
    CoarseLikelihood::FourBounds means;
    for (std::size_t i = 0; i < sums_.size(); ++i) means[i] = sums_[i] / static_cast<double>(full_);
    return means;
  }

 private:
  static constexpr int kFull = std::numeric_limits<std::uint8_t>::max();

  bool MayReach() const { return *std::ranges::max_element(sums_) + left_ >= needed_; }

  void AddSome(std::span<const GridCell> points, const SquareInPlane& square) {
    EightSums sums{};  // Of four cells, and of the four above.
    for (const GridCell& point : points) {
      const std::uint8_t* const at = square.At(point);
      const std::uint64_t above = LoadFour(at + square.next * square.width);
      sums += Widened(LoadFour(at) | above << 32);
    }
    sums_[0] += sums[0];
    sums_[1] += sums[square.next];
    sums_[2] += sums[4];
    sums_[3] += sums[4 + square.next];
  }

  std::array<int, 4> sums_{};
  int full_;
  int left_;  // What the points may add that are not yet added.
  int needed_;
};

}  // namespace

CoarseLikelihood::Plane::Plane(int of_side, int of_shift, int columns, int rows)
    : side(of_side),
      shift(of_shift),
      width(columns),
      height(rows),
      cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + kReadAhead) {}

CoarseLikelihood::CoarseLikelihood(const LikelihoodPyramid& map, const Eigen::AlignedBox2d& area) {
  const GridCell low = map.CellAt(area.min());
  const GridCell high = map.CellAt(area.max());
  const GridCell first{low.x >> LikelihoodTile::kBits, low.y >> LikelihoodTile::kBits};
  const GridCell tiles{(high.x >> LikelihoodTile::kBits) - first.x + 1,
                       (high.y >> LikelihoodTile::kBits) - first.y + 1};
  first_ = {first.x * kTileSide, first.y * kTileSide};
  planes_.push_back(Coarsened(FinestPlane(map, first, tiles), SideOf(0, kFarMove), 0));
  planes_.push_back(Coarsened(planes_.back(), SideOf(1, kFarMove), 1));
  for (int level = 2; level < kLevels; ++level) {
    planes_.push_back(Coarsened(planes_.back(), SideOf(level, 0.5 * kFarMove), level - 1));
    planes_.push_back(Coarsened(planes_.back(), SideOf(level, kFarMove), level - 1));
  }
}

// As they are in the pyramid.
CoarseLikelihood::Plane CoarseLikelihood::FinestPlane(const LikelihoodPyramid& map,
                                                      GridCell first,
                                                      GridCell tiles) {
  Plane plane(1, 0, tiles.x * kTileSide, tiles.y * kTileSide);
  const std::vector<const LikelihoodTile*> found = map.FindTiles(first, tiles);
  auto tile = found.begin();
  for (int row = 0; row < plane.height; row += kTileSide) {
    for (int column = 0; column < plane.width; column += kTileSide, ++tile) {
      if (*tile == nullptr) continue;
      const std::uint8_t* likelihoods = (*tile)->likelihoods(0);
      for (int y = 0; y < kTileSide; ++y, likelihoods += kTileSide) {
        std::copy_n(likelihoods, kTileSide, &plane.cells[plane.Index(column, row + y)]);
      }
    }
  }
  return plane;
}

// One axis after the other: the maximum in a square is that of its columns' maxima.
CoarseLikelihood::Plane CoarseLikelihood::Coarsened(const Plane& fine, int side, int shift) {
  const int halvings = shift - fine.shift;
  const std::vector<int> parts = PartsOf(fine.reach(), fine.stride(), (1 << shift) + side - 1);
  Plane rows(side, shift, fine.width, (fine.height + halvings) >> halvings);
  for (const int part : parts) {
    for (int y = 0; y < rows.height && (y << halvings) + part < fine.height; ++y) {
      RaiseRow(rows.Row(y), fine.Row((y << halvings) + part), 1);
    }
  }
  Plane coarse(side, shift, (fine.width + halvings) >> halvings, rows.height);
  for (const int part : parts) {
    for (int y = 0; y < coarse.height; ++y) {
      RaiseRow(coarse.Row(y), rows.Row(y).subspan(static_cast<std::size_t>(part)), 1 << halvings);
    }
  }
  return coarse;
}

// A square's bounds and those of its neighbours to the right stand in one row of a plane, those of
// the ones above in another.
CoarseLikelihood::FourBounds CoarseLikelihood::BoundsOfFour(int level,
                                                            const Cells& cells,
                                                            GridCell offset,
                                                            double needed) const {
  FourSums sums(cells.near.size() + cells.far.size(), needed);
  const auto add = [&](std::span<const GridCell> points, const Plane& plane) {
    const int margin = (plane.side - WidthOf(level) + 1) / 2;
    sums.Add(points,
             {.cells = plane.cells.data(),
              .width = plane.width,
              .shift = plane.shift,
              .first = {offset.x - first_.x - margin, offset.y - first_.y - margin},
              .next = WidthOf(level) >> plane.shift});
  };
  add(cells.near, NearPlane(level));
  add(cells.far, FarPlane(level));
  return sums.Means();
}

}  // namespace qwsm
