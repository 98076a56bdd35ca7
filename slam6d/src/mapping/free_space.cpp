// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace slam6d {
namespace {

/// Pixels along a side of the cube: 2 degrees each.
constexpr int kSide = 45;

/// A place is compared with the pixel it falls into and those around it. Fewer of these with points
/// do not tell what is seen there.
constexpr int kLeastSeen = 6;

/// Surfaces are as far as this from each other where they count as the same: what two scans differ
/// by through noise, edges and poses that are almost right.
constexpr double kSameSurface_m = 0.15;
constexpr double kSameSurfaceShare = 0.01;

/// About so many points of a scan are held against the other.
constexpr std::size_t kSampleSize = 2000;

constexpr float kNothing = std::numeric_limits<float>::infinity();

struct PixelPlace {
  int face;
  int column;
  int row;
};

std::optional<PixelPlace> PlaceOf(const Eigen::Vector3d& point_m) {
  int axis = 0;
  const double largest_m = point_m.cwiseAbs().maxCoeff(&axis);
  if (!(largest_m > 0.0 && largest_m < 1e9)) return std::nullopt;
  const auto pixel = [&](double coordinate_m) {
    // Equal angles rather than equal lengths, but for a twentieth.
    const double share = coordinate_m / largest_m;
    const double even = share * (1.273 - 0.273 * std::abs(share));
    return std::clamp(static_cast<int>((0.5 + 0.5 * even) * kSide), 0, kSide - 1);
  };
  return PixelPlace{.face = 2 * axis + (point_m(axis) < 0.0 ? 1 : 0),
                    .column = pixel(point_m((axis + 1) % 3)),
                    .row = pixel(point_m((axis + 2) % 3))};
}

std::size_t IndexOf(int face, int column, int row) {
  return static_cast<std::size_t>((face * kSide + row) * kSide + column);
}

}  // namespace

RangeImage::RangeImage(const PointCloud& points)
    : pixels_(static_cast<std::size_t>(6 * kSide * kSide),
              {.nearest_m = kNothing, .farthest_m = -kNothing}) {
  const std::size_t step = points.size() / kSampleSize + 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<PixelPlace> place = PlaceOf(points[i]);
    if (!place) continue;
    Pixel& pixel = pixels_[IndexOf(place->face, place->column, place->row)];
    const auto range_m = static_cast<float>(points[i].norm());
    pixel.nearest_m = std::min(pixel.nearest_m, range_m);
    pixel.farthest_m = std::max(pixel.farthest_m, range_m);
    if (i % step == 0) sample_.push_back(points[i]);
  }
}

RangeImage::Sight RangeImage::At(const Eigen::Vector3d& point_m) const {
  const std::optional<PixelPlace> place = PlaceOf(point_m);
  if (!place) return Sight::kUnknown;
  int seen = 0;
  float nearest_m = kNothing;
  float farthest_m = -kNothing;
  for (int row = std::max(place->row - 1, 0); row <= std::min(place->row + 1, kSide - 1); ++row) {
    for (int column = std::max(place->column - 1, 0);
         column <= std::min(place->column + 1, kSide - 1);
         ++column) {
      const Pixel& pixel = pixels_[IndexOf(place->face, column, row)];
      seen += pixel.nearest_m < kNothing ? 1 : 0;
      nearest_m = std::min(nearest_m, pixel.nearest_m);
      farthest_m = std::max(farthest_m, pixel.farthest_m);
    }
  }
  if (seen < kLeastSeen) return Sight::kUnknown;
  const double range_m = point_m.norm();
  const double margin_m = kSameSurface_m + kSameSurfaceShare * range_m;
  if (range_m < static_cast<double>(nearest_m) - margin_m) return Sight::kFree;
  const bool is_seen = range_m <= static_cast<double>(farthest_m) + margin_m;
  return is_seen ? Sight::kSurface : Sight::kUnknown;
}

double RangeImage::seen_sr() const {
  const auto seen = std::count_if(pixels_.begin(), pixels_.end(), [](const Pixel& pixel) {
    return pixel.nearest_m < kNothing;
  });
  return 4.0 * std::numbers::pi * static_cast<double>(seen) / static_cast<double>(pixels_.size());
}

double Agreement::Contradiction() const {
  return told() > 0 ? static_cast<double>(free) / static_cast<double>(told()) : 0.0;
}

double Agreement::Overlap() const {
  return points > 0 ? static_cast<double>(overlap) / static_cast<double>(points) : 0.0;
}

Agreement Compare(std::span<const RangeImageReference> references,
                  const RangeImage& cur,
                  const Pose3& T_map_cur) {
  Agreement agreement{.points = cur.sample().size()};
  std::vector<bool> is_seen(cur.sample().size(), false);
  const auto note = [&](RangeImage::Sight sight) {
    agreement.surface += sight == RangeImage::Sight::kSurface ? 1 : 0;
    agreement.free += sight == RangeImage::Sight::kFree ? 1 : 0;
    return sight == RangeImage::Sight::kSurface;
  };
  for (const RangeImageReference& ref : references) {
    const Pose3 T_ref_cur = ref.T_map_ref.Inverse() * T_map_cur;
    for (std::size_t i = 0; i < is_seen.size(); ++i) {
      if (note(ref.image->At(T_ref_cur * cur.sample()[i]))) is_seen[i] = true;
    }
    const Pose3 T_cur_ref = T_ref_cur.Inverse();
    const PointCloud& sample = ref.image->sample();
    for (std::size_t i = 0; i < sample.size(); ++i) note(cur.At(T_cur_ref * sample[i]));
  }
  agreement.overlap = static_cast<std::size_t>(std::count(is_seen.begin(), is_seen.end(), true));
  return agreement;
}

}  // namespace slam6d
