// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/person.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

using namespace std::chrono_literals;

constexpr double kArrival_m = 0.3;
constexpr double kResponse_s = 0.3;     // Time in which a walker takes up speed.
constexpr double kStrongest_n = 120.0;  // Not enough to shove a robot along.
constexpr double kLookAhead_m = 0.9;
constexpr auto kBetweenDecisions = 100ms;
constexpr double kNearer_m = 0.1;
constexpr auto kPatience = 4s;   // Without coming nearer for so long, somebody is lost
constexpr auto kStrayTime = 2s;  // and tries any direction.

/// How far somebody of this radius could walk before bumping into something, up to kLookAhead_m.
double FreeWay(const PhysicsWorld& world, BodyId person, double direction_rad, double radius_m) {
  const Eigen::Vector2d position_m = world.PoseOf(person).translation_m();
  const Eigen::Vector2d left(-std::sin(direction_rad), std::cos(direction_rad));
  double free_m = kLookAhead_m;
  for (const double offset_m : {-radius_m, 0.0, radius_m}) {
    const Eigen::Vector2d from_m = position_m + offset_m * left;
    free_m = std::min(free_m, world.CastRay(from_m, direction_rad, kLookAhead_m, person));
  }
  return free_m;
}

}  // namespace

Person::Person(const PersonOptions& options, PhysicsWorld& world, std::uint64_t seed)
    : options_(options), random_(seed) {
  assert(!options.waypoints.empty() && "a person starts somewhere");
  const WaypointOptions& start = options.waypoints.front();
  body_ = world.AddDriven(Disc{options.radius_m}, {start.x_m, start.y_m, 0.0}, options.mass_kg);
  preferred_side_ = Uniform(random_, 0.0, 1.0) < 0.5 ? 1.0 : -1.0;
}

void Person::Walk(PhysicsWorld& world, qwsm::Timestamp now) {
  if (now >= next_decision_) {
    wish_mps_ = Decide(world, now);
    next_decision_ = now + kBetweenDecisions;
  }
  const Eigen::Vector2d missing_mps = wish_mps_ - world.TwistOf(body_).velocity_mps;
  Eigen::Vector2d force_n = options_.mass_kg * missing_mps / kResponse_s;
  if (force_n.norm() > kStrongest_n) force_n *= kStrongest_n / force_n.norm();
  world.Apply(body_, {.force_n = force_n, .torque_nm = 0.0});
}

Eigen::Vector2d Person::Decide(const PhysicsWorld& world, qwsm::Timestamp now) {
  const Eigen::Vector2d position_m = world.PoseOf(body_).translation_m();
  const auto way_m = [&]() -> Eigen::Vector2d {
    return options_.waypoints[goal_].position_m() - position_m;
  };
  if (way_m().norm() < kArrival_m) {
    goal_ = (goal_ + 1) % options_.waypoints.size();
    nearest_m_ = std::numeric_limits<double>::infinity();
  }
  // Somebody with one way point stands still there.
  if (way_m().norm() < kArrival_m) return Eigen::Vector2d::Zero();
  if (way_m().norm() < nearest_m_ - kNearer_m) {
    nearest_m_ = way_m().norm();
    lost_from_ = now + kPatience;
  }
  if (now >= lost_from_) {
    stray_rad_ = Uniform(random_, -std::numbers::pi, std::numbers::pi);
    stray_until_ = now + kStrayTime;
    lost_from_ = now + kPatience;
  }
  const bool strays = now < stray_until_;
  return FreeDirection(world,
                       strays ? stray_rad_ : std::atan2(way_m().y(), way_m().x()),
                       strays ? kLookAhead_m : std::min(kLookAhead_m, way_m().norm()));
}

Eigen::Vector2d Person::FreeDirection(const PhysicsWorld& world,
                                      double ahead_rad,
                                      double enough_m) const {
  for (const double detour_rad : {0.0, 0.6, -0.6, 1.2, -1.2, 1.9, -1.9}) {
    const double direction_rad = ahead_rad + preferred_side_ * detour_rad;
    if (FreeWay(world, body_, direction_rad, options_.radius_m) < enough_m) continue;
    return options_.speed_mps * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
  }
  return Eigen::Vector2d::Zero();
}

}  // namespace sim
