// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/ground.hpp"
#include "sim/physics_world.hpp"

namespace sim {

enum class DriveType {
  kSkidSteer,     ///< Four wheels, the two of a side coupled: turns by scrubbing sideways.
  kDifferential,  ///< Two wheels on one axle through the centre, and a caster without friction.
};

inline std::span<const std::pair<std::string_view, DriveType>> Names(DriveType) {
  static constexpr std::array<std::pair<std::string_view, DriveType>, 2> kNames{
      {{"skid_steer", DriveType::kSkidSteer}, {"differential", DriveType::kDifferential}}};
  return kNames;
}

struct WheelDriveOptions {
  DriveType type = DriveType::kSkidSteer;
  double wheel_radius_m = 0.11;
  double track_m = 0.40;               ///< Distance between left and right wheels.
  double wheelbase_m = 0.28;           ///< Distance between front and rear wheels.
  double max_speed_mps = 1.0;          ///< Greatest speed of a wheel's rim.
  double max_acceleration_mps2 = 1.5;  ///< Greatest acceleration of a wheel's rim.
};

template <class Visitor>
void Describe(Visitor& visit, WheelDriveOptions& o) {
  visit("type", o.type, {.help = "how the wheels are arranged"});
  visit("wheel_radius_m", o.wheel_radius_m, {.help = "radius of a wheel", .min = 0.01, .max = 1});
  visit("track_m", o.track_m, {.help = "between left and right wheels", .min = 0.05, .max = 5});
  visit("wheelbase_m",
        o.wheelbase_m,
        {.help = "between front and rear wheels of a skid steer", .min = 0.05, .max = 5});
  visit("max_speed_mps", o.max_speed_mps, {.help = "of a wheel's rim", .min = 0.01, .max = 20});
  visit("max_acceleration_mps2",
        o.max_acceleration_mps2,
        {.help = "of a wheel's rim", .min = 0.05, .max = 50});
}

/// What a driver asks of a robot.
struct VelocityCommand {
  double forward_mps = 0.0;
  double turn_rad_s = 0.0;  ///< Counter-clockwise rate, in rad/s.
};

/// How much wider than its track a robot's wheels seem to stand when it turns on firm floor. A skid
/// steer's wheels scrub sideways and have to slip along to overcome that: with equal friction
/// along and across, 1 + (wheelbase / track)^2, the "effective track" of Mandow et al. (2007).
double TurnFactor(const WheelDriveOptions& options);

/// Speeds of the wheels' rims on both sides.
struct RimSpeeds {
  double left_mps = 0.0;
  double right_mps = 0.0;
};

/// Motors, wheels and tyres: turns commands into rim speeds and rim speeds into the wrench with
/// which the ground pushes the robot.
///
/// Each tyre pushes against its slip, the velocity of its contact point over the ground, with at
/// most the friction the ground there allows. All that goes wrong with odometry follows from that.
class WheelDrive {
 public:
  /// Makes a drive. @pre mass_kg > 0, inertia_kgm2 > 0
  WheelDrive(const WheelDriveOptions& options, double mass_kg, double inertia_kgm2);

  /// Brings the rims nearer to the command's speeds, as the motors do.
  void Drive(const VelocityCommand& command, std::chrono::duration<double> duration);

  /// The wrench of the ground on a robot that moves like this, over the next `duration`.
  Wrench2 Push(const Ground& ground,
               const qwsm::Pose2& T_world_robot,
               const Twist2& motion,
               std::chrono::duration<double> duration) const;

  const RimSpeeds& rims() const { return rims_; }

 private:
  struct Wheel {
    Eigen::Vector2d p_robot_m;
    bool left;
    double load_n;
  };

  WheelDriveOptions options_;
  double mass_kg_;
  double inertia_kgm2_;
  std::vector<Wheel> wheels_;
  RimSpeeds rims_;
};

}  // namespace sim
