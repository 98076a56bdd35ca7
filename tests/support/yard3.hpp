// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/random.hpp"
#include "sim/solid_world.hpp"

namespace slam6d::test {

/// A yard between four walls with windows set back in them: uneven ground, crates, posts, and trees
/// with round crowns. The walls, unlike those of the simulator, are not all planes, and the trees
/// show surfaces that bend; the middle of the yard is the origin.
class Yard3 {
 public:
  explicit Yard3(std::uint64_t seed);

  double half_width_m() const { return half_width_m_; }
  double GroundM(double x_m, double y_m) const;
  /// How far the ray goes before it meets something; nothing within `max_range_m`.
  std::optional<double> Cast(const sim::Ray3& ray, double max_range_m) const;

 private:
  struct Crate {
    Eigen::Vector3d center_m;
    Eigen::Vector3d half_m;
    double heading_rad;
  };
  struct Post {
    Eigen::Vector2d center_m;
    double radius_m;
    double top_m;
  };
  struct Crown {
    Eigen::Vector3d center_m;
    double radius_m;
  };

  void AddTree(const Eigen::Vector2d& at_m, sim::RandomEngine& random);
  double CastWalls(const sim::Ray3& ray, double max_range_m) const;
  double CastGround(const sim::Ray3& ray, double max_range_m) const;

  double half_width_m_;
  double wall_height_m_;
  Eigen::Vector4d waves_;  ///< Phases of the ground.
  std::vector<Crate> crates_;
  std::vector<Post> posts_;
  std::vector<Crown> crowns_;
};

}  // namespace slam6d::test
