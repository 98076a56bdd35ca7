// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {

// Headings from one to another, both included, in steps from the predicted one.
struct HeadingRange {
  int first = 0;
  int last = 0;
};

// Headings that are looked at together.
struct HeadingGroup {
  HeadingRange headings;
  bool was_searched = false;           // With some offsets, before: see SearchWindow.
  std::span<const CellBox> beam_ends;  // Where each beam ends at any of them.
};

// The cells the beams end in when the robot stands at the prediction, at headings about it. Beams
// that follow each other here are far apart in the scan: any few of them stand for all.
class BeamEnds {
 public:
  // @param memory kept by the ends, which are destroyed before it.
  BeamEnds(const LikelihoodPyramid& map,
           std::span<const Eigen::Vector2d> points_robot_m,
           const SearchWindow& window,
           double max_lever_m,
           SearchMemory& memory);

  std::size_t count() const { return points_.xs_m.size(); }
  double TurnOf(int heading) const { return heading * step_rad_; }
  std::span<const HeadingGroup> groups() const { return groups_; }
  // At one heading. Found when it is first asked for.
  std::span<const GridCell> At(int heading);
  // All ends at any heading are in it.
  CellBox Extent() const;

 private:
  // Positions in the robot's frame by their coordinates, to be turned several at once.
  struct Points {
    std::vector<double> xs_m;
    std::vector<double> ys_m;
    // The same as floats, and the sum of both; some more of these may be read.
    std::vector<float> rough_xs_m;
    std::vector<float> rough_ys_m;
    std::vector<float> rough_sums_m;
  };

  static Points Interleaved(std::span<const Eigen::Vector2d> points_robot_m);
  void AddGroups(HeadingRange headings, bool were_searched);
  std::span<const CellBox> BoxesOf(HeadingRange headings);
  std::span<const GridCell> FindCells(int heading);

  const LikelihoodPyramid& map_;
  SearchMemory& memory_;
  Pose2 center_;
  Points points_;
  double step_rad_ = 0.0;  // Moves a far point by a cell.
  std::vector<HeadingGroup> groups_;
  int first_heading_ = 0;
  std::vector<std::span<const GridCell>> cells_;  // By heading; empty where not yet found.
};

}  // namespace qwsm
