// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/simulated_drive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace qwsm::test {
namespace {

// Beyond this heading error the robot turns on the spot.
constexpr double kAside_rad = 0.5;
constexpr double kSimulationStep_s = 0.01;
constexpr double kArrived_m = 0.1;

// Where the robot is a moment later when it steers for `goal_m`.
Pose2 StepTowards(const Pose2& T_world_robot,
                  const Eigen::Vector2d& goal_m,
                  const DriveOptions& options) {
  const Eigen::Vector2d ahead_m = T_world_robot.Inverse() * goal_m;
  const double aside_rad = std::atan2(ahead_m.y(), ahead_m.x());
  const double turn_limit_rad = options.turn_rate_radps * kSimulationStep_s;
  const double turn_rad = std::clamp(aside_rad, -turn_limit_rad, turn_limit_rad);
  const double step_m =
      std::abs(aside_rad) > kAside_rad ? 0.0 : options.speed_mps * kSimulationStep_s;
  return T_world_robot * Pose2{std::min(step_m, ahead_m.norm()), 0.0, turn_rad};
}

Pose2 ErringMotion(const Pose2& motion, const OdometryErrors& errors, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double path_m = motion.translation_m().norm();
  const double turn_rad = std::abs(motion.theta_rad);
  const double position_sigma_m = errors.position_sigma_m_per_sqrt_m * std::sqrt(path_m);
  const double heading_sigma_rad =
      std::hypot(errors.heading_sigma_rad_per_sqrt_m * std::sqrt(path_m),
                 errors.heading_sigma_rad_per_sqrt_rad * std::sqrt(turn_rad));
  const double x_m = errors.path_scale * motion.x_m + position_sigma_m * normal(random);
  const double y_m = errors.path_scale * motion.y_m + position_sigma_m * normal(random);
  const double theta_rad =
      errors.turn_scale * motion.theta_rad + heading_sigma_rad * normal(random);
  return {x_m, y_m, NormalizeAngle(theta_rad)};
}

}  // namespace

std::vector<Pose2> PosesAlong(std::span<const Eigen::Vector2d> route_m,
                              const DriveOptions& options) {
  if (route_m.size() < 2) throw std::invalid_argument("a route has at least two points");
  const Eigen::Vector2d first_leg_m = route_m[1] - route_m[0];
  Pose2 T_world_robot{route_m[0].x(), route_m[0].y(), std::atan2(first_leg_m.y(), first_leg_m.x())};
  const auto steps_per_scan = std::max(1L, std::lround(options.scan_period_s / kSimulationStep_s));
  std::vector<Pose2> poses = {T_world_robot};
  long steps = 0;
  for (const Eigen::Vector2d& goal_m : route_m.subspan(1)) {
    while ((goal_m - T_world_robot.translation_m()).norm() > kArrived_m) {
      T_world_robot = StepTowards(T_world_robot, goal_m, options);
      if (++steps % steps_per_scan == 0) poses.push_back(T_world_robot);
    }
  }
  return poses;
}

std::vector<Pose2> ErringOdometry(std::span<const Pose2> T_world_robot,
                                  const OdometryErrors& errors,
                                  std::mt19937_64& random) {
  std::vector<Pose2> T_odom_robot = {Pose2{}};
  for (std::size_t i = 1; i < T_world_robot.size(); ++i) {
    const Pose2 motion = T_world_robot[i - 1].Inverse() * T_world_robot[i];
    T_odom_robot.push_back(T_odom_robot.back() * ErringMotion(motion, errors, random));
  }
  return T_odom_robot;
}

SimulatedDrive DriveThrough(const Scene& scene, const DriveOptions& options) {
  std::mt19937_64 random(options.seed);
  SimulatedDrive drive{.observations = {}, .T_world_robot = PosesAlong(scene.route_m, options)};
  const std::vector<Pose2> T_odom_robot =
      ErringOdometry(drive.T_world_robot, options.odometry, random);
  const auto period =
      std::chrono::duration_cast<Timestamp>(std::chrono::duration<double>(options.scan_period_s));
  for (std::size_t i = 0; i < drive.T_world_robot.size(); ++i) {
    LaserScan scan = Measure(options.laser, scene.world, drive.T_world_robot[i], random);
    scan.stamp = static_cast<int>(i) * period;
    drive.observations.push_back({.scan = std::move(scan), .T_odom_robot = T_odom_robot[i]});
  }
  return drive;
}

}  // namespace qwsm::test
