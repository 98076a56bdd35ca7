// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// What a scanner saw of the space around it: up to the nearest and the farthest point in every
/// direction, by pixels of about two degrees on the six faces of a cube about it.
class RangeImage {
 public:
  /// Sees the points from the origin of their frame. O(points).
  explicit RangeImage(const PointCloud& points);

  enum class Sight : std::uint8_t {
    kUnknown,  ///< Behind what the scanner saw, or where it saw nothing.
    kSurface,  ///< As far as what the scanner saw there.
    kFree,     ///< The scanner saw through this place, to something behind it.
  };
  /// What the scanner knows of a place in its frame.
  Sight At(const Eigen::Vector3d& point_m) const;

  /// How much of the sphere around it the scanner saw, in steradian.
  double seen_sr() const;
  /// A few of the points, spread over what was seen.
  const PointCloud& sample() const { return sample_; }

 private:
  struct Pixel {
    float nearest_m;
    float farthest_m;
  };

  std::vector<Pixel> pixels_;
  PointCloud sample_;
};

/// What two scans say of each other's points.
struct Agreement {
  std::size_t points = 0;   ///< Points of the current scan that were asked about.
  std::size_t overlap = 0;  ///< Of these, those on what a reference saw, too.
  std::size_t surface = 0;  ///< Points of any scan on what the other scanner saw, too.
  std::size_t free = 0;     ///< Points where the other scanner saw nothing but air.

  /// Points of which the other scanner tells anything.
  std::size_t told() const { return surface + free; }
  /// Share of the points told about that contradict the other scan; 0 if nothing is told.
  double Contradiction() const;
  /// Share of the current scan's points that lie on what a reference saw.
  double Overlap() const;
};

/// A scan that stands still in the frame map.
struct RangeImageReference {
  const RangeImage* image;
  Pose3 T_map_ref;
};

/// Holds the points of every scan against what the other saw.
Agreement Compare(std::span<const RangeImageReference> references,
                  const RangeImage& cur,
                  const Pose3& T_map_cur);

}  // namespace slam6d
