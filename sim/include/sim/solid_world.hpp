// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/scenery.hpp"
#include "sim/terrain.hpp"

namespace sim {

/// Heights of things that a scenario knows by their outlines.
struct SolidOptions {
  double wall_height_m = 2.5;
  double box_height_m = 1.0;
  double round_height_m = 5.0;  ///< Height of trees and columns.
  TerrainOptions terrain;
};

template <class Visitor>
void Describe(Visitor& visit, SolidOptions& o) {
  visit("wall_height_m", o.wall_height_m, {.help = "of walls", .min = 0.1, .max = 100});
  visit("box_height_m", o.box_height_m, {.help = "of boxes", .min = 0.1, .max = 100});
  visit("round_height_m", o.round_height_m, {.help = "of trees, columns", .min = 0.1, .max = 100});
  visit("terrain", o.terrain, {.help = "the ground they stand on"});
}

/// A ray of light in the world.
struct Ray3 {
  Eigen::Vector3d origin_m;
  Eigen::Vector3d direction;  ///< Direction of unit length.
};

/// The world of a scenario in space: its walls and boxes extruded, its round things as columns, on
/// ground with slopes and steps. What moves is left out.
class SolidWorld {
 public:
  SolidWorld(const SceneryOptions& scenery, const SolidOptions& options);

  const Terrain& terrain() const { return terrain_; }

  /// How far the ray goes before it meets something; nothing within `max_range_m`.
  /// O(things + max_range_m).
  std::optional<double> Cast(const Ray3& ray, double max_range_m) const;

 private:
  /// A wall or a box: an upright block on an oblong.
  struct Block {
    qwsm::Pose2 T_world_block;
    Eigen::Vector2d half_m;
    double top_m;
  };
  struct Column {
    Eigen::Vector2d center_m;
    double radius_m;
    double top_m;
  };

  void Add(const qwsm::Pose2& T_world_block, const Eigen::Vector2d& half_m, double height_m);
  std::optional<double> CastGround(const Ray3& ray, double max_range_m) const;

  Terrain terrain_;
  std::vector<Block> blocks_;
  std::vector<Column> columns_;
};

}  // namespace sim
