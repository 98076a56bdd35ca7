// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/wheel_drive.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "gravity.hpp"

namespace sim {
namespace {

constexpr double kShareOnDrivenWheels = 0.8;    // Of a differential drive; the caster has the rest.
constexpr double kCrawl_mps = 0.05;             // Slip ratios are over at least this rim speed.
constexpr double kRollingFriction_mps = 0.005;  // Rolling resistance is full from this speed on.
constexpr int kSlipIterations = 4;
constexpr std::size_t kMaxWheels = 4;

/// Friction of one tyre as two dampers, along and across the wheel, in N s / m.
struct TyreDamping {
  double along = 0.0;
  double across = 0.0;
  double rolling = 0.0;  ///< Against rolling itself, whatever the motor does.
};

/// The dampers that give the tyre's force at this slip: force grows with slip until friction is
/// used up, then stays (Coulomb) while the damper gets softer.
TyreDamping DampingAt(const SurfaceOptions& surface,
                      double load_n,
                      const Eigen::Vector2d& contact_mps,
                      double rim_mps) {
  const Eigen::Vector2d slip_mps(contact_mps.x() - rim_mps, contact_mps.y());
  const double full_slip_mps =
      surface.full_slip_ratio * std::max({std::abs(rim_mps), contact_mps.norm(), kCrawl_mps});
  const double grip = load_n / std::max(slip_mps.norm(), full_slip_mps);
  // A wheel that rolls passes over the turf, one that is turned in place digs in.
  const double in_place =
      std::abs(slip_mps.y()) / (std::abs(slip_mps.y()) + std::abs(contact_mps.x()) + kCrawl_mps);
  return {.along = surface.traction * grip,
          .across = surface.lateral * (1.0 + surface.scrub * in_place) * grip,
          .rolling = surface.rolling_resistance * load_n /
                     std::max(std::abs(contact_mps.x()), kRollingFriction_mps)};
}

/// Velocity of a contact point, along and across its wheel, by (vx, vy, yaw rate) of the robot.
Eigen::Matrix<double, 2, 3> ContactJacobian(const Eigen::Vector2d& p_robot_m) {
  return Eigen::Matrix<double, 2, 3>{{1.0, 0.0, -p_robot_m.y()}, {0.0, 1.0, p_robot_m.x()}};
}

double Approach(double from, double to, double max_change) {
  return from + std::clamp(to - from, -max_change, max_change);
}

}  // namespace

double TurnFactor(const WheelDriveOptions& options) {
  if (options.type == DriveType::kDifferential) return 1.0;
  const double ratio = options.wheelbase_m / options.track_m;
  return 1.0 + ratio * ratio;
}

WheelDrive::WheelDrive(const WheelDriveOptions& options, double mass_kg, double inertia_kgm2)
    : options_(options), mass_kg_(mass_kg), inertia_kgm2_(inertia_kgm2) {
  assert(mass_kg > 0.0 && inertia_kgm2 > 0.0 && "a robot has a mass");
  const double side_m = 0.5 * options.track_m;
  const double weight_n = mass_kg * kGravity_mps2;
  if (options.type == DriveType::kDifferential) {
    const double load_n = 0.5 * kShareOnDrivenWheels * weight_n;
    wheels_ = {{{0.0, side_m}, true, load_n}, {{0.0, -side_m}, false, load_n}};
    return;
  }
  const double end_m = 0.5 * options.wheelbase_m;
  const double load_n = 0.25 * weight_n;
  wheels_ = {{{end_m, side_m}, true, load_n},
             {{-end_m, side_m}, true, load_n},
             {{end_m, -side_m}, false, load_n},
             {{-end_m, -side_m}, false, load_n}};
}

void WheelDrive::Drive(const VelocityCommand& command, std::chrono::duration<double> duration) {
  const double turn_mps = 0.5 * options_.track_m * TurnFactor(options_) * command.turn_rad_s;
  double left_mps = command.forward_mps - turn_mps;
  double right_mps = command.forward_mps + turn_mps;
  // Too fast a command is slowed down as a whole, so that the robot keeps to its curve.
  const double fastest_mps = std::max(std::abs(left_mps), std::abs(right_mps));
  const double share = std::min(1.0, options_.max_speed_mps / std::max(fastest_mps, 1e-9));
  const double max_change_mps = options_.max_acceleration_mps2 * duration.count();
  rims_.left_mps = Approach(rims_.left_mps, share * left_mps, max_change_mps);
  rims_.right_mps = Approach(rims_.right_mps, share * right_mps, max_change_mps);
}

Wrench2 WheelDrive::Push(const Ground& ground,
                         const qwsm::Pose2& T_world_robot,
                         const Twist2& motion,
                         std::chrono::duration<double> duration) const {
  // Friction is far stiffer than a step is short, so the step is implicit: with the dampers K of
  // each tyre, M (u - u0) = -dt sum J^T (K (J u - rim) + K_roll J u) is solved for the motion u
  // after the step, and the dampers are then those of the new slip. Stable for any duration, and
  // adds no energy beyond what the rims bring in.
  const Eigen::Matrix2d R_robot_world = T_world_robot.Rotation().transpose();
  const Eigen::Vector2d velocity_mps = R_robot_world * motion.velocity_mps;
  const Eigen::Vector3d before(velocity_mps.x(), velocity_mps.y(), motion.yaw_rate_rad_s);
  const Eigen::Vector3d inertia(mass_kg_, mass_kg_, inertia_kgm2_);
  std::array<SurfaceOptions, kMaxWheels> surfaces;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    surfaces[i] = ground.At(T_world_robot * wheels_[i].p_robot_m);
  }

  Eigen::Vector3d after = before;
  for (int iteration = 0; iteration < kSlipIterations; ++iteration) {
    Eigen::Matrix3d A = inertia.asDiagonal();
    Eigen::Vector3d b = inertia.cwiseProduct(before);
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const Eigen::Matrix<double, 2, 3> J = ContactJacobian(wheels_[i].p_robot_m);
      const double rim_mps = wheels_[i].left ? rims_.left_mps : rims_.right_mps;
      const TyreDamping damping = DampingAt(surfaces[i], wheels_[i].load_n, J * after, rim_mps);
      const Eigen::Vector2d resisting(damping.along + damping.rolling, damping.across);
      A += duration.count() * J.transpose() * resisting.asDiagonal() * J;
      b += duration.count() * damping.along * rim_mps * J.row(0).transpose();
    }
    after = A.llt().solve(b);
  }
  const Eigen::Vector3d wrench_robot = inertia.cwiseProduct(after - before) / duration.count();
  return {.force_n = R_robot_world.transpose() * wrench_robot.head<2>(),
          .torque_nm = wrench_robot.z()};
}

}  // namespace sim
