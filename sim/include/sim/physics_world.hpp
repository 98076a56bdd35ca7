// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <memory>
#include <variant>

#include "qwsm/geometry/pose2.hpp"

namespace sim {

struct Disc {
  double radius_m = 0.0;
};

/// A rectangle centred on its body, `length_m` along the body's x axis.
struct Rectangle {
  double length_m = 0.0;
  double width_m = 0.0;
};

using Outline = std::variant<Disc, Rectangle>;

/// Names one body of a PhysicsWorld.
enum class BodyId : std::size_t {};

/// The motion of a body: the velocity of its centre along the world's axes, and its turning.
struct Twist2 {
  Eigen::Vector2d velocity_mps = Eigen::Vector2d::Zero();
  double yaw_rate_rad_s = 0.0;
};

/// The force on a body at its centre along the world's axes, and the torque.
struct Wrench2 {
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double torque_nm = 0.0;
};

/// Rigid bodies seen from above: they move, collide and stop rays. There is no gravity in the
/// plane; what the ground does to a body comes in as a wrench or, for loose bodies, as friction.
///
/// Wraps Box2D, whose 32-bit coordinates resolve 0.01 mm within 100 m of the origin and 0.03 mm
/// within 500 m. Equal calls give equal results, bit for bit.
class PhysicsWorld {
 public:
  PhysicsWorld();
  ~PhysicsWorld();
  PhysicsWorld(const PhysicsWorld&) = delete;
  PhysicsWorld& operator=(const PhysicsWorld&) = delete;

  /// Adds a body that nothing moves.
  BodyId AddFixed(const Outline& outline, const qwsm::Pose2& T_world_body);

  /// Adds a body of even density that moves by the wrenches applied to it.
  /// @pre mass_kg > 0
  BodyId AddDriven(const Outline& outline, const qwsm::Pose2& T_world_body, double mass_kg);

  /// Adds a body that lies on the ground: it slides when pushed by more than its friction force.
  /// @pre mass_kg > 0, friction_force_n >= 0
  BodyId AddLoose(const Outline& outline,
                  const qwsm::Pose2& T_world_body,
                  double mass_kg,
                  double friction_force_n);

  /// Takes a body up and puts it down elsewhere, at rest.
  void Put(BodyId id, const qwsm::Pose2& T_world_body);

  qwsm::Pose2 PoseOf(BodyId id) const;
  Twist2 TwistOf(BodyId id) const;
  double MassOf(BodyId id) const;  ///< Mass in kg; 0 for a fixed body.
  /// Moment of inertia about the centre, in kg m^2; 0 for a fixed body.
  double MomentOfInertiaOf(BodyId id) const;

  /// Applies a wrench until the end of the next Step(); several wrenches add up.
  void Apply(BodyId id, const Wrench2& wrench);

  void Step(std::chrono::duration<double> duration);

  /// How far a ray runs from `from_world_m` until it meets a body other than `ignored`; infinite
  /// where it meets none within `length_m`. A body that contains the start does not stop it.
  /// O(log bodies) where bodies are spread out.
  double CastRay(const Eigen::Vector2d& from_world_m,
                 double direction_world_rad,
                 double length_m,
                 BodyId ignored) const;

  /// Whether the outline, laid at the pose, would overlap a body.
  bool IsOccupied(const Outline& outline, const qwsm::Pose2& T_world_outline) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim
