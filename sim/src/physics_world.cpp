// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/physics_world.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace sim {
namespace {

// More than Box2D's usual 8 and 3: few bodies move here, and persons squeeze robots against walls.
constexpr int kVelocityIterations = 12;
constexpr int kPositionIterations = 6;
constexpr float kBumperFriction = 0.4F;
constexpr float kBumperRestitution = 0.1F;

b2Vec2 ToBox2D(const Eigen::Vector2d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

Eigen::Vector2d FromBox2D(const b2Vec2& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

b2CircleShape ToShape(const Disc& disc) {
  b2CircleShape shape;
  shape.m_radius = static_cast<float>(disc.radius_m);
  return shape;
}

b2PolygonShape ToShape(const Rectangle& rectangle) {
  b2PolygonShape shape;
  shape.SetAsBox(static_cast<float>(0.5 * rectangle.length_m),
                 static_cast<float>(0.5 * rectangle.width_m));
  return shape;
}

/// About the centre, per kilogram, in m^2.
double RadiusOfGyrationSquared(const Disc& disc) { return 0.5 * disc.radius_m * disc.radius_m; }

double RadiusOfGyrationSquared(const Rectangle& rectangle) {
  return (rectangle.length_m * rectangle.length_m + rectangle.width_m * rectangle.width_m) / 12.0;
}

/// Where the ray from `start_m` along the unit vector `direction` enters the circle. In double
/// precision: Box2D's own formula squares the whole ray's length in floats, which puts errors of
/// millimetres on a thin trunk and loses grazing hits.
std::optional<double> DistanceToCircle(const Eigen::Vector2d& start_m,
                                       const Eigen::Vector2d& direction,
                                       const Eigen::Vector2d& center_m,
                                       double radius_m) {
  const Eigen::Vector2d to_center_m = center_m - start_m;
  const double along_m = to_center_m.dot(direction);
  const double across_m = direction.x() * to_center_m.y() - direction.y() * to_center_m.x();
  const double half_chord_m2 = radius_m * radius_m - across_m * across_m;
  if (half_chord_m2 < 0.0) return std::nullopt;
  const double distance_m = along_m - std::sqrt(half_chord_m2);
  if (distance_m < 0.0) return std::nullopt;
  return distance_m;
}

/// Walks the tree of bounding boxes along one ray and keeps the nearest surface.
class NearestSurface {
 public:
  NearestSurface(const b2BroadPhase& broad_phase, const b2Body* ignored)
      : broad_phase_(broad_phase), ignored_(ignored) {}

  double Find(const Eigen::Vector2d& start_m, const Eigen::Vector2d& direction, double length_m) {
    start_m_ = start_m;
    direction_ = direction;
    length_m_ = length_m;
    nearest_m_ = std::numeric_limits<double>::infinity();
    b2RayCastInput input;
    input.p1 = ToBox2D(start_m);
    input.p2 = ToBox2D(start_m + length_m * direction);
    input.maxFraction = 1.0F;
    broad_phase_.RayCast(this, input);
    return nearest_m_ <= length_m ? nearest_m_ : std::numeric_limits<double>::infinity();
  }

  /// Called by Box2D for each bounding box met; returns the fraction of the ray still of interest.
  float RayCastCallback(const b2RayCastInput& input, int32 proxy_id) {
    const auto* proxy = static_cast<const b2FixtureProxy*>(broad_phase_.GetUserData(proxy_id));
    const b2Fixture& fixture = *proxy->fixture;
    if (fixture.GetBody() == ignored_) return input.maxFraction;
    const std::optional<double> distance_m = DistanceTo(fixture, input);
    if (!distance_m || *distance_m >= nearest_m_) return input.maxFraction;
    nearest_m_ = *distance_m;
    // Box2D reads a fraction of 0 as "stop", which is right: nothing is nearer.
    return std::min(input.maxFraction, static_cast<float>(nearest_m_ / length_m_));
  }

 private:
  std::optional<double> DistanceTo(const b2Fixture& fixture, const b2RayCastInput& input) const {
    if (fixture.GetType() == b2Shape::e_circle) {
      return DistanceToCircle(start_m_,
                              direction_,
                              FromBox2D(fixture.GetBody()->GetPosition()),
                              static_cast<double>(fixture.GetShape()->m_radius));
    }
    b2RayCastOutput output;
    if (!fixture.RayCast(&output, input, 0)) return std::nullopt;
    return static_cast<double>(output.fraction) * length_m_;
  }

  const b2BroadPhase& broad_phase_;
  const b2Body* ignored_;
  Eigen::Vector2d start_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d direction_ = Eigen::Vector2d::UnitX();
  double length_m_ = 0.0;
  double nearest_m_ = std::numeric_limits<double>::infinity();
};

/// Looks for a fixture that overlaps a shape.
class OverlapSearch : public b2QueryCallback {
 public:
  OverlapSearch(const b2Shape& shape, const b2Transform& pose) : shape_(shape), pose_(pose) {}

  bool ReportFixture(b2Fixture* fixture) override {
    found_ = b2TestOverlap(
        &shape_, 0, fixture->GetShape(), 0, pose_, fixture->GetBody()->GetTransform());
    return !found_;
  }

  bool found() const { return found_; }

 private:
  const b2Shape& shape_;
  const b2Transform& pose_;
  bool found_ = false;
};

}  // namespace

struct PhysicsWorld::Implementation {
  b2World world{b2Vec2(0.0F, 0.0F)};
  b2Body* ground = nullptr;
  std::vector<b2Body*> bodies;

  b2Body& Body(BodyId id) const {
    assert(static_cast<std::size_t>(id) < bodies.size() && "the body belongs to this world");
    return *bodies[static_cast<std::size_t>(id)];
  }

  b2Body& Add(b2BodyType type, const Outline& outline, const qwsm::Pose2& T_world_body) {
    b2BodyDef definition;
    definition.type = type;
    definition.position = ToBox2D(T_world_body.translation_m());
    definition.angle = static_cast<float>(T_world_body.theta_rad);
    definition.allowSleep = false;
    b2Body* body = world.CreateBody(&definition);
    std::visit(
        [body](const auto& kind) {
          const auto shape = ToShape(kind);
          b2FixtureDef fixture;
          fixture.shape = &shape;
          fixture.friction = kBumperFriction;
          fixture.restitution = kBumperRestitution;
          body->CreateFixture(&fixture);
        },
        outline);
    bodies.push_back(body);
    return *body;
  }

  BodyId Last() const { return BodyId{bodies.size() - 1}; }
};

PhysicsWorld::PhysicsWorld() : implementation_(std::make_unique<Implementation>()) {
  const b2BodyDef definition;
  implementation_->ground = implementation_->world.CreateBody(&definition);
}

PhysicsWorld::~PhysicsWorld() = default;

BodyId PhysicsWorld::AddFixed(const Outline& outline, const qwsm::Pose2& T_world_body) {
  implementation_->Add(b2_staticBody, outline, T_world_body);
  return implementation_->Last();
}

BodyId PhysicsWorld::AddDriven(const Outline& outline,
                               const qwsm::Pose2& T_world_body,
                               double mass_kg) {
  assert(mass_kg > 0.0 && "a body that moves has a mass");
  b2Body& body = implementation_->Add(b2_dynamicBody, outline, T_world_body);
  const double inertia_kgm2 =
      mass_kg * std::visit([](const auto& kind) { return RadiusOfGyrationSquared(kind); }, outline);
  b2MassData mass;
  mass.mass = static_cast<float>(mass_kg);
  mass.center.SetZero();
  mass.I = static_cast<float>(inertia_kgm2);
  body.SetMassData(&mass);
  return implementation_->Last();
}

BodyId PhysicsWorld::AddLoose(const Outline& outline,
                              const qwsm::Pose2& T_world_body,
                              double mass_kg,
                              double friction_force_n) {
  assert(friction_force_n >= 0.0 && "friction never pushes");
  const BodyId id = AddDriven(outline, T_world_body, mass_kg);
  b2Body& body = implementation_->Body(id);
  const double radius_m = std::sqrt(MomentOfInertiaOf(id) / mass_kg);
  b2FrictionJointDef friction;
  friction.Initialize(implementation_->ground, &body, body.GetWorldCenter());
  friction.maxForce = static_cast<float>(friction_force_n);
  friction.maxTorque = static_cast<float>(friction_force_n * radius_m);
  friction.collideConnected = true;
  implementation_->world.CreateJoint(&friction);
  return id;
}

void PhysicsWorld::Put(BodyId id, const qwsm::Pose2& T_world_body) {
  b2Body& body = implementation_->Body(id);
  body.SetTransform(ToBox2D(T_world_body.translation_m()),
                    static_cast<float>(T_world_body.theta_rad));
  body.SetLinearVelocity({0.0F, 0.0F});
  body.SetAngularVelocity(0.0F);
}

qwsm::Pose2 PhysicsWorld::PoseOf(BodyId id) const {
  const b2Body& body = implementation_->Body(id);
  const Eigen::Vector2d position_m = FromBox2D(body.GetPosition());
  return {
      position_m.x(), position_m.y(), qwsm::NormalizeAngle(static_cast<double>(body.GetAngle()))};
}

Twist2 PhysicsWorld::TwistOf(BodyId id) const {
  const b2Body& body = implementation_->Body(id);
  return {.velocity_mps = FromBox2D(body.GetLinearVelocity()),
          .yaw_rate_rad_s = static_cast<double>(body.GetAngularVelocity())};
}

double PhysicsWorld::MassOf(BodyId id) const {
  return static_cast<double>(implementation_->Body(id).GetMass());
}

double PhysicsWorld::MomentOfInertiaOf(BodyId id) const {
  return static_cast<double>(implementation_->Body(id).GetInertia());
}

void PhysicsWorld::Apply(BodyId id, const Wrench2& wrench) {
  b2Body& body = implementation_->Body(id);
  body.ApplyForceToCenter(ToBox2D(wrench.force_n), true);
  body.ApplyTorque(static_cast<float>(wrench.torque_nm), true);
}

void PhysicsWorld::Step(std::chrono::duration<double> duration) {
  implementation_->world.Step(
      static_cast<float>(duration.count()), kVelocityIterations, kPositionIterations);
}

double PhysicsWorld::CastRay(const Eigen::Vector2d& from_world_m,
                             double direction_world_rad,
                             double length_m,
                             BodyId ignored) const {
  NearestSurface search(implementation_->world.GetContactManager().m_broadPhase,
                        &implementation_->Body(ignored));
  const Eigen::Vector2d direction(std::cos(direction_world_rad), std::sin(direction_world_rad));
  return search.Find(from_world_m, direction, length_m);
}

bool PhysicsWorld::IsOccupied(const Outline& outline, const qwsm::Pose2& T_world_outline) const {
  const b2Transform pose(ToBox2D(T_world_outline.translation_m()),
                         b2Rot(static_cast<float>(T_world_outline.theta_rad)));
  return std::visit(
      [&](const auto& kind) {
        const auto shape = ToShape(kind);
        b2AABB box;
        shape.ComputeAABB(&box, pose, 0);
        OverlapSearch search(shape, pose);
        implementation_->world.QueryAABB(&search, box);
        return search.found();
      },
      outline);
}

}  // namespace sim
