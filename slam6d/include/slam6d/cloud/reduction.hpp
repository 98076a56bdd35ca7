// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d {

/// What stands for the points of a cube.
enum class ReductionChoice {
  kMean,           ///< The mean of the points: the noise is averaged.
  kNearestToMean,  ///< The point nearest to the mean: one that was measured.
  kRandom,         ///< At most `points_per_voxel` of the points, drawn at random.
};

inline std::span<const std::pair<std::string_view, ReductionChoice>> Names(ReductionChoice) {
  static constexpr std::array<std::pair<std::string_view, ReductionChoice>, 3> kNames{{
      {"mean", ReductionChoice::kMean},
      {"nearest-to-mean", ReductionChoice::kNearestToMean},
      {"random", ReductionChoice::kRandom},
  }};
  return kNames;
}

struct ReductionOptions {
  double voxel_m = 0.0;  ///< Edge of the cubes; 0 keeps every point.
  ReductionChoice keep = ReductionChoice::kMean;
  int points_per_voxel = 1;  ///< Most points kept of a cube by kRandom.
  int seed = 1;
};

template <class Visitor>
void Describe(Visitor& visit, ReductionOptions& o) {
  visit("voxel_m",
        o.voxel_m,
        {.help = "edge of the cubes; 0 keeps every point", .min = 0, .max = 1000});
  visit("keep", o.keep, {.help = "what stands for the points of a cube"});
  visit("points_per_voxel",
        o.points_per_voxel,
        {.help = "of random ones, at most", .min = 1, .max = 1e6});
  visit("seed", o.seed, {.help = "of the draw of random ones", .min = 0, .max = 1e9});
}

/// The cloud thinned by an octree: where a scanner sees much, it needs no more points than
/// elsewhere. The same cloud and options give the same points. O(n log n).
PointCloud Reduce(const PointCloud& cloud, const ReductionOptions& options);

}  // namespace slam6d
