// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "beam_ends.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace qwsm {
namespace {

// All of the points, each far from the one before: in steps of about a golden section of them.
std::vector<Eigen::Vector2d> Interleaved(std::span<const Eigen::Vector2d> points) {
  constexpr double kGoldenSection = 0.618;
  std::size_t step = static_cast<std::size_t>(kGoldenSection * static_cast<double>(points.size()));
  while (std::gcd(step, points.size()) != 1) ++step;
  std::vector<Eigen::Vector2d> interleaved;
  interleaved.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    interleaved.push_back(points[i * step % points.size()]);
  }
  return interleaved;
}

}  // namespace

BeamEnds::BeamEnds(const LikelihoodPyramid& map,
                   std::span<const Eigen::Vector2d> points_robot_m,
                   const SearchWindow& window,
                   double max_lever_m)
    : points_(points_robot_m.size()) {
  double lever_m = 1.0;
  for (const Eigen::Vector2d& p : points_robot_m) lever_m = std::max(lever_m, p.norm());
  step_rad_ = map.cell_size_m() / std::min(lever_m, max_lever_m);
  cells_per_heading_ = static_cast<int>(std::ceil(step_rad_ * lever_m / map.cell_size_m())) + 1;
  headings_ = static_cast<int>(std::ceil(window.rotation_rad / step_rad_));
  const std::vector<Eigen::Vector2d> interleaved_m = Interleaved(points_robot_m);
  cells_.resize(points_ * static_cast<std::size_t>(2 * headings_ + 1));
  auto cell = cells_.begin();
  const Pose2& center = window.predicted.T_a_b;
  for (int heading = -headings_; heading <= headings_; ++heading) {
    const RigidTransform2 turned({center.x_m, center.y_m, center.theta_rad + TurnOf(heading)});
    for (const Eigen::Vector2d& p_robot : interleaved_m) *cell++ = map.CellAt(turned * p_robot);
  }
}

LikelihoodWindow BeamEnds::WindowOf(const LikelihoodPyramid& map,
                                    int first,
                                    int last,
                                    std::uint8_t max_drift_code) const {
  // Between the headings looked at, no cell moves further than the margin.
  constexpr int kHeadingsApart = 8;
  const int margin = headings_ == 0 ? 0 : kHeadingsApart * cells_per_heading_;
  GridCell low = cells_.front();
  GridCell high = low;
  for (int heading = -headings_; heading <= headings_; heading += kHeadingsApart) {
    for (const GridCell& cell : At(heading)) {
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
  }
  return {map,
          {low.x - margin + first, low.y - margin + first},
          {high.x + margin + last, high.y + margin + last},
          max_drift_code};
}

}  // namespace qwsm
