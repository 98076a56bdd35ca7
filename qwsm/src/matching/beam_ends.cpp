// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "beam_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace qwsm {
namespace {

constexpr int kHeadingsOfGroup = 8;

// Every processor of the last twenty years computes with four floats at once.
using FourFloats = float __attribute__((vector_size(16)));
using FourCells = std::int32_t __attribute__((vector_size(16)));
constexpr std::size_t kAtOnce = 4;

FourFloats LoadFour(const std::vector<float>& values, std::size_t first) {
  FourFloats four;
  std::memcpy(&four, values.data() + first, sizeof(four));
  return four;
}

FourCells Floor(FourFloats values) {
  const FourCells towards_zero = __builtin_convertvector(values, FourCells);
  return towards_zero + (__builtin_convertvector(towards_zero, FourFloats) > values);
}

// Where coordinates are at two headings, and anywhere between that is no further beyond.
struct FourIntervals {
  FourIntervals(FourFloats at_first, FourFloats at_last, FourFloats beyond)
      : low(Floor((at_first < at_last ? at_first : at_last) - beyond)),
        high(Floor((at_first < at_last ? at_last : at_first) + beyond)) {}

  FourCells low;
  FourCells high;
};

// Turns by an angle, and from metres to cells.
struct RoughTurn {
  RoughTurn(double angle_rad, double cells_per_metre)
      : c(static_cast<float>(cells_per_metre * std::cos(angle_rad))),
        s(static_cast<float>(cells_per_metre * std::sin(angle_rad))) {}

  float c;
  float s;
};

}  // namespace

BeamEnds::BeamEnds(const LikelihoodPyramid& map,
                   std::span<const Eigen::Vector2d> points_robot_m,
                   const SearchWindow& window,
                   double max_lever_m,
                   SearchMemory& memory)
    : map_(map),
      memory_(memory),
      center_(window.predicted.T_a_b),
      points_(Interleaved(points_robot_m)) {
  double lever_m = 1.0;
  for (const Eigen::Vector2d& p : points_robot_m) lever_m = std::max(lever_m, p.norm());
  step_rad_ = map.cell_size_m() / std::min(lever_m, max_lever_m);
  const auto steps = [this](double turn_rad) {
    return static_cast<int>(std::ceil(turn_rad / step_rad_));
  };
  const int last = steps(window.rotation_rad);
  first_heading_ = -last;
  cells_.resize(static_cast<std::size_t>(2 * last + 1));
  if (!window.searched) {
    AddGroups({-last, last}, false);
    return;
  }
  const int searched = std::min(last, steps(window.searched->rotation_rad));
  AddGroups({-searched, searched}, true);
  AddGroups({-last, -searched - 1}, false);
  AddGroups({searched + 1, last}, false);
}

// All of the points, each far from the one before: in steps of about a golden section of them.
BeamEnds::Points BeamEnds::Interleaved(std::span<const Eigen::Vector2d> points_robot_m) {
  constexpr double kGoldenSection = 0.618;
  const std::size_t count = points_robot_m.size();
  std::size_t step = static_cast<std::size_t>(kGoldenSection * static_cast<double>(count));
  while (std::gcd(step, count) != 1) ++step;
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d& p_m = points_robot_m[i * step % count];
    points.xs_m.push_back(p_m.x());
    points.ys_m.push_back(p_m.y());
  }
  for (std::vector<float>* rough : {&points.rough_xs_m, &points.rough_ys_m, &points.rough_sums_m}) {
    rough->resize(count + kAtOnce - 1);
  }
  for (std::size_t i = 0; i < count; ++i) {
    points.rough_xs_m[i] = static_cast<float>(points.xs_m[i]);
    points.rough_ys_m[i] = static_cast<float>(points.ys_m[i]);
    points.rough_sums_m[i] = std::abs(points.rough_xs_m[i]) + std::abs(points.rough_ys_m[i]);
  }
  return points;
}

void BeamEnds::AddGroups(HeadingRange headings, bool were_searched) {
  const int count = headings.last - headings.first + 1;
  const int groups = (count + kHeadingsOfGroup - 1) / kHeadingsOfGroup;
  for (int group = 0; group < groups; ++group) {  // All but equally large.
    const HeadingRange some{.first = headings.first + count * group / groups,
                            .last = headings.first + count * (group + 1) / groups - 1};
    groups_.push_back(
        {.headings = some, .was_searched = were_searched, .beam_ends = BoxesOf(some)});
  }
}

// From one heading to another a beam ends in the box about its ends there, but for the arc's bulge,
// which no sum of coordinates is too short to tell.
std::span<const CellBox> BeamEnds::BoxesOf(HeadingRange headings) {
  constexpr double kRoundingPerCell = 1e-6;
  constexpr float kRounding = 0.01F;
  const double cells_per_metre = 1.0 / map_.cell_size_m();
  const double first_rad = TurnOf(headings.first);
  const double last_rad = TurnOf(headings.last);
  const RoughTurn first(center_.theta_rad + first_rad, cells_per_metre);
  const RoughTurn last(center_.theta_rad + last_rad, cells_per_metre);
  const double bulge = 1.0 - std::cos(0.5 * (last_rad - first_rad));
  const auto beyond_per_metre = static_cast<float>(cells_per_metre * (bulge + kRoundingPerCell));
  const GridCell origin = map_.CellAt(center_.translation_m());
  const auto x = static_cast<float>(cells_per_metre * center_.x_m - origin.x);
  const auto y = static_cast<float>(cells_per_metre * center_.y_m - origin.y);
  const std::span<CellBox> boxes = memory_.Take<CellBox>(count());
  for (std::size_t i = 0; i < count(); i += kAtOnce) {
    const FourFloats xs_m = LoadFour(points_.rough_xs_m, i);
    const FourFloats ys_m = LoadFour(points_.rough_ys_m, i);
    const FourFloats beyond = kRounding + beyond_per_metre * LoadFour(points_.rough_sums_m, i);
    const FourIntervals of_x(
        first.c * xs_m - first.s * ys_m + x, last.c * xs_m - last.s * ys_m + x, beyond);
    const FourIntervals of_y(
        first.s * xs_m + first.c * ys_m + y, last.s * xs_m + last.c * ys_m + y, beyond);
    for (std::size_t k = 0; k < std::min(kAtOnce, count() - i); ++k) {
      boxes[i + k] = {.low = {origin.x + of_x.low[k], origin.y + of_y.low[k]},
                      .high = {origin.x + of_x.high[k], origin.y + of_y.high[k]}};
    }
  }
  return boxes;
}

CellBox BeamEnds::Extent() const {
  CellBox extent = groups_.front().beam_ends.front();
  for (const HeadingGroup& group : groups_) {
    for (const CellBox& box : group.beam_ends) {
      extent.low = {std::min(extent.low.x, box.low.x), std::min(extent.low.y, box.low.y)};
      extent.high = {std::max(extent.high.x, box.high.x), std::max(extent.high.y, box.high.y)};
    }
  }
  return extent;
}

std::span<const GridCell> BeamEnds::At(int heading) {
  std::span<const GridCell>& cells = cells_[static_cast<std::size_t>(heading - first_heading_)];
  if (cells.empty()) cells = FindCells(heading);
  return cells;
}

std::span<const GridCell> BeamEnds::FindCells(int heading) {
  const RigidTransform2 turned({center_.x_m, center_.y_m, center_.theta_rad + TurnOf(heading)});
  const double c = turned.R_a_b(0, 0);
  const double s = turned.R_a_b(1, 0);
  const Eigen::Vector2d t_m = turned.t_a_b_m;
  const std::span<GridCell> cells = memory_.Take<GridCell>(count());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = {map_.CellIndex(c * points_.xs_m[i] - s * points_.ys_m[i] + t_m.x()),
                map_.CellIndex(s * points_.xs_m[i] + c * points_.ys_m[i] + t_m.y())};
  }
  return cells;
}

}  // namespace qwsm
