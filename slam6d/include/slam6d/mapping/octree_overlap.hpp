// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// Options of the heuristic for an initial guess (Nüchter et al. 2007, section 3.2). It searches
/// within the ranges about the guess; its steps follow from the size of the cubes.
struct OverlapOptions {
  double cube_m = 0.2;  ///< Edge of the smallest cubes.
  int levels = 3;       ///< The search begins with cubes twice as large for each level above one.
  double translation_range_m = 1.0;
  double rotation_range_rad = 10.0 * std::numbers::pi / 180.0;
  int max_cubes = 800;    ///< Most cubes of the current scan that are looked up for each motion.
  double min_gain = 0.1;  ///< The guess is left only for an overlap larger by this share.
};

template <class Visitor>
void Describe(Visitor& visit, OverlapOptions& o) {
  visit("cube_m", o.cube_m, {.help = "edge of the smallest cubes", .min = 0.001, .max = 100});
  visit("levels",
        o.levels,
        {.help = "sizes of cubes, each twice the one before; 0 trusts the guess",
         .min = 0,
         .max = 8});
  visit("translation_range_m",
        o.translation_range_m,
        {.help = "the guess may be off by so much in x and y", .min = 0, .max = 1000});
  visit("rotation_range_rad",
        o.rotation_range_rad,
        {.help = "the guess may be off by so much in yaw", .min = 0, .max = std::numbers::pi});
  visit("max_cubes",
        o.max_cubes,
        {.help = "cubes looked up for each motion tried", .min = 10, .max = 1e6});
  visit(
      "min_gain",
      o.min_gain,
      {.help = "the guess is left only for an overlap larger by this share", .min = 0, .max = 10});
}

/// The occupied cubes of one size, for asking whether a point lies in one. Expected O(1).
class CubeSet {
 public:
  CubeSet(const Eigen::Vector3d& origin_m, double cube_m, std::vector<std::uint64_t> keys);

  double cube_m() const { return cube_m_; }
  bool Contains(const Eigen::Vector3d& point_m) const;

 private:
  Eigen::Vector3d origin_m_;
  double cube_m_;
  std::uint64_t mask_ = 0;
  std::vector<std::uint64_t> table_;  ///< Open addressing; kFree where nothing is.
};

/// The octree of a scan, as the heuristic needs it.
class OverlapModel {
 public:
  OverlapModel(const PointCloud& cloud, const OverlapOptions& options);

  /// The occupied cubes of each level, the smallest first.
  const std::vector<CubeSet>& levels() const { return levels_; }
  /// The mean of the points of every smallest cube; neighbours stand near each other.
  const std::vector<Eigen::Vector3d>& means_m() const { return means_m_; }
  /// Root mean square distance of the cubes' means from the scanner, but for stray points.
  double radius_m() const { return radius_m_; }

 private:
  std::vector<CubeSet> levels_;
  std::vector<Eigen::Vector3d> means_m_;
  double radius_m_ = 0.0;
};

/// A scan that stands still in the frame map.
struct OverlapReference {
  const OverlapModel* model;
  Pose3 T_map_ref;
};

/// The share of the current scan's smallest cubes that lie in occupied cubes of any reference; 0
/// for an empty scan.
double Overlap(std::span<const OverlapReference> references,
               const OverlapModel& cur,
               const Pose3& T_map_cur,
               const OverlapOptions& options);

struct OverlapGuess {
  Pose3 T_map_cur;
  double overlap = 0.0;
  std::size_t motions_tried = 0;
};

/// The motion near the guess under which most cubes overlap, coarse to fine; the guess itself where
/// none is clearly better.
OverlapGuess GuessByOverlap(std::span<const OverlapReference> references,
                            const OverlapModel& cur,
                            const Pose3& T_map_cur_guess,
                            const OverlapOptions& options);

}  // namespace slam6d
