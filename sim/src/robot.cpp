// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/robot.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <utility>

#include "qwsm/sensor/deskew.hpp"

namespace sim {
namespace {

constexpr double kDriversView_m = 2.0;

/// From the front of a robot to the nearest thing straight ahead, up to kDriversView_m; or from its
/// back to what is behind it, if it is turned round by pi.
double FreeAlong(const PhysicsWorld& world,
                 BodyId body,
                 const RobotOptions& options,
                 double turned_rad) {
  const qwsm::Pose2 T_world_view = world.PoseOf(body) * qwsm::Pose2{0.0, 0.0, turned_rad};
  const double to_end_m = 0.5 * options.length_m;
  double free_m = kDriversView_m;
  for (const double side : {-0.5, 0.0, 0.5}) {
    const Eigen::Vector2d from_m = T_world_view * Eigen::Vector2d(0.0, side * options.width_m);
    const double range_m =
        world.CastRay(from_m, T_world_view.theta_rad, to_end_m + kDriversView_m, body);
    free_m = std::min(free_m, range_m - to_end_m);
  }
  return free_m;
}

bool IsPast(qwsm::Timestamp now, double time_s) {
  return now >= std::chrono::round<qwsm::Timestamp>(std::chrono::duration<double>(time_s));
}

}  // namespace

bool IsFileName(const std::string& name) {
  const auto is_legal = [](unsigned char c) { return c != '/' && std::iscntrl(c) == 0; };
  return !name.empty() && !name.starts_with('.') && std::ranges::all_of(name, is_legal);
}

qwsm::Pose2 ToldStart(const RobotOptions& options, const qwsm::Pose2& T_world_start) {
  return {T_world_start.x_m + options.told_start_off_x_m,
          T_world_start.y_m + options.told_start_off_y_m,
          qwsm::NormalizeAngle(T_world_start.theta_rad + options.told_start_off_heading_rad)};
}

qwsm::Observation ObservationOf(const Reading& reading) {
  const bool has_skew = reading.scan.sweep.count() > 0;
  return {.scan = has_skew ? qwsm::Deskewed(reading.scan, reading.T_first_last) : reading.scan,
          .T_odom_robot = reading.T_odom_robot,
          .gyro_rad = reading.gyro_rad};
}

Robot::Robot(const RobotPlacement& placement, std::uint64_t seed, PhysicsWorld& world)
    : options_(placement.options),
      body_(world.AddDriven(Rectangle{options_.length_m, options_.width_m},
                            placement.T_world_robot,
                            options_.mass_kg)),
      drive_(options_.drive, options_.mass_kg, world.MomentOfInertiaOf(body_)),
      odometry_(options_.odometry, options_.drive, SeedFor("odometry", seed)),
      gyro_(options_.gyro, SeedFor("gyro", seed)),
      driver_(options_.driver, placement.route, SeedFor("driver", seed)) {
  if (options_.gyro.enabled) imu_.emplace_back();  // It stands at the start.
  Mount(options_.laser, SeedFor("laser", seed));
  for (const LaserOptions& laser : options_.more_lasers) {
    Mount(laser, SeedFor("laser " + std::to_string(lasers_.size()), seed));
  }
}

void Robot::Drive(PhysicsWorld& world,
                  const Ground& ground,
                  qwsm::Timestamp now,
                  std::chrono::nanoseconds step) {
  CarryIfDue(world, now);
  const qwsm::Pose2 T_world_robot = world.PoseOf(body_);
  const DriverView view{.now = now,
                        .T_world_robot = T_world_robot,
                        .free_ahead_m = FreeAlong(world, body_, options_, 0.0),
                        .free_behind_m = FreeAlong(world, body_, options_, std::numbers::pi)};
  const bool has_joined = IsPast(now, options_.joins_at_s);
  drive_.Drive(has_joined ? driver_.Decide(view) : VelocityCommand{}, step);
  world.Apply(body_, drive_.Push(ground, T_world_robot, world.TwistOf(body_), step));
}

void Robot::CarryIfDue(PhysicsWorld& world, qwsm::Timestamp now) {
  if (times_carried_ == options_.carried.size()) return;
  const CarriedOptions& carried = options_.carried[times_carried_];
  if (!IsPast(now, carried.at_s)) return;
  const auto waypoints = static_cast<std::size_t>(carried.waypoints);
  const qwsm::Pose2 T_world_there = driver_.PoseAhead(waypoints);
  if (world.IsOccupied(Rectangle{options_.length_m, options_.width_m}, T_world_there)) return;
  world.Put(body_, T_world_there);
  driver_.GoOnAhead(waypoints);
  ++times_carried_;
}

void Robot::Advance(const PhysicsWorld& world, qwsm::Timestamp now, std::chrono::nanoseconds step) {
  odometry_.Advance(drive_.rims(), step);
  ReadGyro(world, now, step);
}

void Robot::ReadGyro(const PhysicsWorld& world,
                     qwsm::Timestamp now,
                     std::chrono::nanoseconds step) {
  const double turned_before_rad = gyro_.turned_rad();
  gyro_.Advance(world.TwistOf(body_).yaw_rate_rad_s, step);
  if (!options_.gyro.enabled) return;
  const double rate_rad_s = (gyro_.turned_rad() - turned_before_rad) / qwsm::Seconds(step);
  imu_.push_back({.stamp = now, .turn_rate_rad_s = {0.0, 0.0, rate_rad_s}});
}

void Robot::Scan(const PhysicsWorld& world, qwsm::Timestamp now, std::vector<Reading>& completed) {
  for (MountedLaser& mounted : lasers_) {
    if (mounted.laser.is_scanning()) {
      mounted.laser.Continue(world, body_, now);
    } else if (mounted.IsDue(now)) {
      BeginScan(world, now, mounted);
    }
    std::optional<qwsm::LaserScan> scan = mounted.laser.Take();
    if (!scan) continue;
    completed.push_back(mounted.reading);
    EndScan(std::move(*scan), now, completed.back());
    completed.back().imu = std::exchange(imu_, {});
  }
}

// The last beam may have been cast before the end of a step: the motion is even.
void Robot::EndScan(qwsm::LaserScan scan, qwsm::Timestamp now, Reading& reading) const {
  reading.scan = std::move(scan);
  const std::chrono::duration<double> sweep = reading.scan.sweep;
  if (sweep.count() <= 0.0) return;
  qwsm::Pose2 motion = reading.T_odom_robot.Inverse() * odometry_.T_odom_robot();
  if (reading.gyro_rad) motion.theta_rad = gyro_.turned_rad() - *reading.gyro_rad;
  const double share = sweep / std::chrono::duration<double>(now - reading.scan.stamp);
  reading.T_first_last = {share * motion.x_m, share * motion.y_m, share * motion.theta_rad};
}

void Robot::Mount(LaserOptions options, std::uint64_t seed) {
  options.first_scan_s += options_.joins_at_s;
  lasers_.push_back({.options = options, .laser = Laser(options, seed)});
  lasers_.back().reading.laser = lasers_.size() - 1;
}

void Robot::BeginScan(const PhysicsWorld& world, qwsm::Timestamp now, MountedLaser& mounted) {
  ++mounted.scans_begun;
  mounted.reading.T_odom_robot = odometry_.T_odom_robot();
  mounted.reading.T_world_robot = world.PoseOf(body_);
  if (options_.gyro.enabled) mounted.reading.gyro_rad = gyro_.turned_rad();
  mounted.laser.Begin(world, body_, now);
}

bool Robot::MountedLaser::IsDue(qwsm::Timestamp now) const {
  const std::chrono::duration<double> due(options.first_scan_s +
                                          static_cast<double>(scans_begun) / options.rate_hz);
  return now >= std::chrono::round<qwsm::Timestamp>(due) && due.count() < options.breaks_at_s;
}

}  // namespace sim
