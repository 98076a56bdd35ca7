// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/solid_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The part of a ray that lies in something convex, as ranges; empty where last < first.
struct Stretch {
  double first_m = 0.0;
  double last_m = kInfinity;

  void Meet(double first, double last) {
    first_m = std::max(first_m, first);
    last_m = std::min(last_m, last);
  }
  /// Where a ray from outside enters; nothing where it passes by.
  std::optional<double> Entry() const {
    return first_m > 0.0 && first_m <= last_m ? std::optional(first_m) : std::nullopt;
  }
};

/// low <= origin + range * slope <= high.
void MeetSlab(double origin, double slope, double low, double high, Stretch& stretch) {
  if (slope == 0.0) {
    if (origin < low || origin > high) stretch.Meet(kInfinity, -kInfinity);
    return;
  }
  const auto [near, far] = std::minmax({(low - origin) / slope, (high - origin) / slope});
  stretch.Meet(near, far);
}

}  // namespace

SolidWorld::SolidWorld(const SceneryOptions& scenery, const SolidOptions& options)
    : terrain_(options.terrain) {
  for (const WallOptions& wall : scenery.walls) {
    const Eigen::Vector2d from(wall.from_x_m, wall.from_y_m);
    const Eigen::Vector2d along = Eigen::Vector2d(wall.to_x_m, wall.to_y_m) - from;
    const Eigen::Vector2d center = from + 0.5 * along;
    Add({center.x(), center.y(), std::atan2(along.y(), along.x())},
        {0.5 * along.norm(), 0.5 * wall.thickness_m},
        options.wall_height_m);
  }
  for (const BoxOptions& box : scenery.boxes) {
    Add({box.x_m, box.y_m, qwsm::NormalizeAngle(box.heading_rad)},
        {0.5 * box.length_m, 0.5 * box.width_m},
        options.box_height_m);
  }
  for (const RoundOptions& round : scenery.rounds) {
    const Eigen::Vector2d center(round.x_m, round.y_m);
    columns_.push_back({.center_m = center,
                        .radius_m = round.radius_m,
                        .top_m = terrain_.HeightM(center) + options.round_height_m});
  }
}

void SolidWorld::Add(const qwsm::Pose2& T_world_block,
                     const Eigen::Vector2d& half_m,
                     double height_m) {
  const double ground_m = terrain_.HeightM(T_world_block.translation_m());
  blocks_.push_back(
      {.T_world_block = T_world_block, .half_m = half_m, .top_m = ground_m + height_m});
}

std::optional<double> SolidWorld::Cast(const Ray3& ray, double max_range_m) const {
  const Eigen::Vector2d origin = ray.origin_m.head<2>();
  const Eigen::Vector2d direction = ray.direction.head<2>();
  double nearest_m = max_range_m;
  bool is_hit = false;
  const auto take = [&](const std::optional<double>& entry_m) {
    if (!entry_m || *entry_m > nearest_m) return;
    nearest_m = *entry_m;
    is_hit = true;
  };
  for (const Block& block : blocks_) {
    const qwsm::Pose2 T_block_world = block.T_world_block.Inverse();
    const Eigen::Vector2d o = T_block_world * origin;
    const Eigen::Vector2d d = T_block_world * Eigen::Vector2d(origin + direction) - o;
    Stretch inside;
    MeetSlab(o.x(), d.x(), -block.half_m.x(), block.half_m.x(), inside);
    MeetSlab(o.y(), d.y(), -block.half_m.y(), block.half_m.y(), inside);
    MeetSlab(ray.origin_m.z(), ray.direction.z(), -kInfinity, block.top_m, inside);
    take(inside.Entry());
  }
  for (const Column& column : columns_) {
    const Eigen::Vector2d o = origin - column.center_m;
    const double a = direction.squaredNorm();
    const double b = o.dot(direction);
    const double root2 = b * b - a * (o.squaredNorm() - column.radius_m * column.radius_m);
    if (root2 <= 0.0 || a == 0.0) continue;
    Stretch inside{(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a};
    MeetSlab(ray.origin_m.z(), ray.direction.z(), -kInfinity, column.top_m, inside);
    take(inside.Entry());
  }
  take(CastGround(ray, nearest_m));
  return is_hit ? std::optional(nearest_m) : std::nullopt;
}

// The ground has no closed form: steps, then halving.
std::optional<double> SolidWorld::CastGround(const Ray3& ray, double max_range_m) const {
  constexpr double kStep_m = 0.2;
  constexpr int kHalvings = 30;
  const auto is_below = [&](double range_m) {
    const Eigen::Vector3d p = ray.origin_m + range_m * ray.direction;
    return p.z() < terrain_.HighestM() && p.z() < terrain_.HeightM(p.head<2>());
  };
  for (double above_m = 0.0; above_m < max_range_m; above_m += kStep_m) {
    if (!is_below(above_m + kStep_m)) continue;
    double below_m = above_m + kStep_m;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle_m = 0.5 * (above_m + below_m);
      (is_below(middle_m) ? below_m : above_m) = middle_m;
    }
    return below_m;
  }
  return std::nullopt;
}

}  // namespace sim
