// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ground.hpp"

#include <cmath>
#include <limits>

#include "sim/random.hpp"

namespace sim {
namespace {

constexpr double kPatchSize_m = 0.5;

/// A number in [-1, 1] that belongs to one corner of the lattice of patches.
double CornerValue(double column, double row, std::uint64_t seed) {
  const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(column));
  const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(row));
  const std::uint64_t bits = Scramble(Scramble(seed ^ x) ^ y);
  return 2.0 * static_cast<double>(bits) /
             static_cast<double>(std::numeric_limits<std::uint64_t>::max()) -
         1.0;
}

/// Value noise in [-1, 1]: corner values, blended linearly in between.
double PatchNoise(const Eigen::Vector2d& p_world_m, std::uint64_t seed) {
  const double column = std::floor(p_world_m.x() / kPatchSize_m);
  const double row = std::floor(p_world_m.y() / kPatchSize_m);
  const double u = p_world_m.x() / kPatchSize_m - column;
  const double v = p_world_m.y() / kPatchSize_m - row;
  const double lower =
      std::lerp(CornerValue(column, row, seed), CornerValue(column + 1.0, row, seed), u);
  const double upper = std::lerp(
      CornerValue(column, row + 1.0, seed), CornerValue(column + 1.0, row + 1.0, seed), u);
  return std::lerp(lower, upper, v);
}

bool Contains(const GroundRegionOptions& region, const Eigen::Vector2d& p_world_m) {
  return p_world_m.x() >= region.min_x_m && p_world_m.x() <= region.max_x_m &&
         p_world_m.y() >= region.min_y_m && p_world_m.y() <= region.max_y_m;
}

}  // namespace

SurfaceOptions Ground::At(const Eigen::Vector2d& p_world_m) const {
  SurfaceOptions surface = KindAt(p_world_m);
  if (surface.patchiness == 0.0) return surface;
  const double scale = 1.0 + surface.patchiness * PatchNoise(p_world_m, seed_);
  surface.traction *= scale;
  surface.lateral *= scale;
  return surface;
}

const SurfaceOptions& Ground::KindAt(const Eigen::Vector2d& p_world_m) const {
  Surface kind = options_.everywhere;
  for (const GroundRegionOptions& region : options_.regions) {
    if (Contains(region, p_world_m)) kind = region.surface;
  }
  return kind == Surface::kGrass ? options_.grass : options_.floor;
}

}  // namespace sim
