// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "qwsm/sensor/laser_scan.hpp"
#include "sim/physics_world.hpp"
#include "sim/random.hpp"
#include "sim/waypoint.hpp"

namespace sim {

struct PersonOptions {
  Route waypoints{};  ///< Way points, walked from the first to the last and over again.
  double speed_mps = 1.1;
  double radius_m = 0.22;
  double mass_kg = 75.0;
};

template <class Visitor>
void Describe(Visitor& visit, PersonOptions& o) {
  visit("waypoints", o.waypoints, {.help = "walked from the first to the last and over again"});
  visit("speed_mps", o.speed_mps, {.help = "walking speed", .min = 0, .max = 5});
  visit("radius_m", o.radius_m, {.help = "half the width", .min = 0.02, .max = 1});
  visit("mass_kg", o.mass_kg, {.help = "mass", .min = 1, .max = 500});
}

template <class Report>
void Validate(const PersonOptions& o, Report& report) {
  if (o.waypoints.empty()) report("waypoints", "a person needs one to start from");
}

/// Somebody who walks about, looks where they go, steps aside for what is in the way, and waits
/// where there is no way round.
class Person {
 public:
  /// Enters the world at the first way point. @pre there is one
  Person(const PersonOptions& options, PhysicsWorld& world, std::uint64_t seed);

  /// Applies the legs' force for the next step.
  void Walk(PhysicsWorld& world, qwsm::Timestamp now);

  BodyId body() const { return body_; }
  const PersonOptions& options() const { return options_; }

 private:
  /// The velocity to take up: towards the goal, or past what stands there, or anywhere if lost.
  Eigen::Vector2d Decide(const PhysicsWorld& world, qwsm::Timestamp now);

  /// The walking velocity nearest to the direction that leads nowhere into anything.
  Eigen::Vector2d FreeDirection(const PhysicsWorld& world, double ahead_rad, double enough_m) const;

  PersonOptions options_;
  BodyId body_;
  double preferred_side_ = 1.0;  ///< +1 passes on the left first, -1 on the right.
  std::size_t goal_ = 0;
  /// Nearest distance to the goal so far.
  double nearest_m_ = std::numeric_limits<double>::infinity();
  /// When the person counts as lost, unless the goal is neared before.
  qwsm::Timestamp lost_from_{};
  qwsm::Timestamp stray_until_{};
  double stray_rad_ = 0.0;
  qwsm::Timestamp next_decision_{};
  Eigen::Vector2d wish_mps_ = Eigen::Vector2d::Zero();
  RandomEngine random_;
};

}  // namespace sim
