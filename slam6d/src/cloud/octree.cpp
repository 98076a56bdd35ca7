// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/cloud/octree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "slam6d/cloud/bounds.hpp"

namespace slam6d {
namespace {

/// Spreads 21 bits so that two zeros stand between each two of them.
std::uint64_t SpreadBits(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x1f00000000ffffU;
  bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

/// Morton (1966): the cubes in the order in which one walks through the octree.
std::uint64_t MortonCode(const CubePlace& place) {
  return SpreadBits(place[0]) | SpreadBits(place[1]) << 1U | SpreadBits(place[2]) << 2U;
}

/// Farther away nothing was ever measured; and the extent of what is nearer is a number.
constexpr double kFarthest_m = 1e9;

/// A cloud's finite points and the box around them.
struct Extent {
  std::vector<std::uint32_t> points;
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();
};

Extent ExtentOf(const PointCloud& cloud) {
  Extent extent;
  extent.points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point_m = cloud[i];
    if (!(point_m.cwiseAbs().maxCoeff() < kFarthest_m) || !point_m.allFinite()) continue;
    extent.low_m = extent.points.empty() ? point_m : extent.low_m.cwiseMin(point_m);
    extent.high_m = extent.points.empty() ? point_m : extent.high_m.cwiseMax(point_m);
    extent.points.push_back(static_cast<std::uint32_t>(i));
  }
  return extent;
}

/// Of the points of a cloud that is too wide for its cubes, this share at each end of an axis may
/// be stray ones.
constexpr double kStrayShare = 0.025;

/// The same without the points that may be stray.
Extent WithoutStrays(const PointCloud& cloud, const Extent& all) {
  Extent extent = all;
  std::vector<double> along_m(all.points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(
        all.points, along_m.begin(), [&](std::uint32_t point) { return cloud[point](axis); });
    const Bounds bounds_m = BoundsOf(along_m, kStrayShare);
    extent.low_m(axis) = bounds_m.low;
    extent.high_m(axis) = bounds_m.high;
  }
  return extent;
}

double WidestM(const Extent& extent) { return (extent.high_m - extent.low_m).maxCoeff(); }

struct CodedPoint {
  std::uint64_t code;
  std::uint32_t point;
};

/// Sorts by code; points of one code stay in their order. O(n) for codes of few bits: a radix sort.
void SortByCode(std::vector<CodedPoint>& coded) {
  constexpr unsigned kBits = 11;  // The counts of a pass fit into the nearest cache.
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  std::uint64_t used = 0;
  for (const CodedPoint& point : coded) used |= point.code;
  std::vector<CodedPoint> sorted(coded.size());
  for (unsigned shift = 0; shift < 64 && (used >> shift) != 0; shift += kBits) {
    const auto digit = [&](const CodedPoint& point) { return (point.code >> shift) % kDigits; };
    std::array<std::uint32_t, kDigits> next{};
    for (const CodedPoint& point : coded) ++next[digit(point)];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const CodedPoint& point : coded) sorted[next[digit(point)]++] = point;
    coded.swap(sorted);
  }
}

}  // namespace

CubePlace PlaceOf(const Eigen::Vector3d& point_m, const Eigen::Vector3d& origin_m, double cube_m) {
  const Eigen::Vector3d cubes = (point_m - origin_m) / cube_m;
  return {static_cast<std::uint32_t>(cubes.x()),
          static_cast<std::uint32_t>(cubes.y()),
          static_cast<std::uint32_t>(cubes.z())};
}

Octree::Octree(const PointCloud& cloud, double cube_m) : cube_m_(cube_m) {
  assert(cube_m > 0.0 && "cubes have an edge");
  const Extent extent = ExtentOf(cloud);
  origin_m_ = extent.low_m;
  if (!(WidestM(extent) / cube_m_ < kMaxCubes - 1)) {
    const Extent most = WithoutStrays(cloud, extent);
    while (!(WidestM(most) / cube_m_ < kMaxCubes - 1)) cube_m_ *= 2.0;
    const Eigen::Vector3d center_m = 0.5 * (most.low_m + most.high_m);
    origin_m_ = center_m.array() - 0.5 * kMaxCubes * cube_m_;
  }
  const auto place_of = [&](std::uint32_t point) {
    const Eigen::Vector3d highest_m = origin_m_.array() + (kMaxCubes - 0.5) * cube_m_;
    return PlaceOf(cloud[point].cwiseMax(origin_m_).cwiseMin(highest_m), origin_m_, cube_m_);
  };

  std::vector<CodedPoint> coded;
  coded.reserve(extent.points.size());
  for (const std::uint32_t point : extent.points) {
    coded.push_back({MortonCode(place_of(point)), point});
  }
  SortByCode(coded);
  points_.reserve(coded.size());
  for (std::size_t i = 0; i < coded.size(); ++i) {
    if (i == 0 || coded[i].code != coded[i - 1].code) {
      first_.push_back(static_cast<std::uint32_t>(i));
      places_.push_back(place_of(coded[i].point));
    }
    points_.push_back(coded[i].point);
  }
  first_.push_back(static_cast<std::uint32_t>(coded.size()));
}

}  // namespace slam6d
