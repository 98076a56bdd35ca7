// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {

// The cells the beams end in when the robot stands at the prediction, at headings about it. Beams
// that follow each other here are far apart in the scan: any few of them stand for all.
class BeamEnds {
 public:
  BeamEnds(const LikelihoodPyramid& map,
           std::span<const Eigen::Vector2d> points_robot_m,
           const SearchWindow& window,
           double max_lever_m);

  std::size_t count() const { return points_; }  // At a heading.
  // Headings -last_heading() .. last_heading() are known.
  int last_heading() const { return headings_; }
  double TurnOf(int heading) const { return heading * step_rad_; }
  std::span<const GridCell> At(int heading) const {
    return std::span(cells_).subspan(static_cast<std::size_t>(heading + headings_) * points_,
                                     points_);
  }

  // What of the map they meet when moved by first .. last cells in x and y.
  LikelihoodWindow WindowOf(const LikelihoodPyramid& map,
                            int first,
                            int last,
                            std::uint8_t max_drift_code) const;

 private:
  std::size_t points_;
  double step_rad_ = 0.0;      // Moves a far point by a cell.
  int cells_per_heading_ = 0;  // Most that a cell moves from heading to heading.
  int headings_ = 0;
  std::vector<GridCell> cells_;  // One heading after the other.
};

}  // namespace qwsm
