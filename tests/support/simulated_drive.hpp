// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/mapping/observation.hpp"
#include "tests/support/simulated_laser.hpp"
#include "tests/support/world.hpp"

namespace qwsm::test {

/// How odometry errs, in the robot's frame. The variances grow with the path and the turn, so that
/// the error of a drive does not depend on how often it is sampled.
struct OdometryErrors {
  double position_sigma_m_per_sqrt_m = 0.02;
  double heading_sigma_rad_per_sqrt_m = 0.01;
  double heading_sigma_rad_per_sqrt_rad = 0.03;
  double path_scale = 1.02;  ///< Of every distance, a worn tyre.
  double turn_scale = 0.99;  ///< Of every turn, a wrong wheel base.
};

/// A robot that steers for the points of a route, turning on the spot where they lie aside.
struct DriveOptions {
  SimulatedLaser laser = {};
  OdometryErrors odometry = {};
  double speed_mps = 0.5;
  double turn_rate_radps = 0.7;
  double scan_period_s = 0.4;
  std::uint64_t seed = 1;
};

/// What was measured, and where the robot was at each of the measurements.
struct SimulatedDrive {
  std::vector<Observation> observations;
  std::vector<Pose2> T_world_robot;
};

/// The true poses of a drive at every `scan_period_s`, from the first point of the route, heading
/// for the second, to the last.
/// @throws std::invalid_argument for a route of fewer than two points.
std::vector<Pose2> PosesAlong(std::span<const Eigen::Vector2d> route_m,
                              const DriveOptions& options);

/// What odometry says at each of the poses; the first reading is the origin.
std::vector<Pose2> ErringOdometry(std::span<const Pose2> T_world_robot,
                                  const OdometryErrors& errors,
                                  std::mt19937_64& random);

SimulatedDrive DriveThrough(const Scene& scene, const DriveOptions& options);

}  // namespace qwsm::test
