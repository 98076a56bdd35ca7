// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/observation.hpp"
#include "qwsm/sensor/imu_reading.hpp"
#include "sim/driver.hpp"
#include "sim/gyro.hpp"
#include "sim/laser.hpp"
#include "sim/odometry.hpp"
#include "sim/physics_world.hpp"
#include "sim/wheel_drive.hpp"

namespace sim {

/// Somebody takes a robot up and puts it down elsewhere, at once. Its sensors tell nothing of it.
struct CarriedOptions {
  double at_s = 0.0;  ///< When; later where another one stands there.
  int waypoints = 1;  ///< So many way points further on its way.
};

template <class Visitor>
void Describe(Visitor& visit, CarriedOptions& o) {
  visit("at_s", o.at_s, {.help = "when, or as soon as there is room", .min = 0, .max = 1e6});
  visit("waypoints",
        o.waypoints,
        {.help = "to the way point so many further on its way", .min = 1, .max = 10000});
}

struct RobotOptions {
  std::string name = "robot";
  /// Start along x; not looked at where the robot drives a route of the layout.
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double start_heading_rad = 0.0;
  /// Where along a route of the layout it starts, as a share of its way points, to go on from
  /// there.
  double start_on_route = 0.0;
  double joins_at_s = 0.0;  ///< Until then it stands at its start and takes no scans.
  bool tells_start = true;  ///< Whether it says where it starts, one of several robots.
  /// How far what it says is off, in the world.
  double told_start_off_x_m = 0.0;
  double told_start_off_y_m = 0.0;
  double told_start_off_heading_rad = 0.0;
  std::vector<CarriedOptions> carried{};
  double length_m = 0.5;
  double width_m = 0.5;
  double mass_kg = 30.0;
  WheelDriveOptions drive;
  OdometryOptions odometry;
  GyroOptions gyro;
  LaserOptions laser;
  std::vector<LaserOptions> more_lasers{};  ///< Besides that one.
  DriverOptions driver;
};

template <class Visitor>
void Describe(Visitor& visit, RobotOptions& o) {
  visit("name", o.name, {.help = "name of the robot"});
  visit("start_x_m",
        o.start_x_m,
        {.help = "start, if way points are given", .min = -1e4, .max = 1e4});
  visit("start_y_m",
        o.start_y_m,
        {.help = "start, if way points are given", .min = -1e4, .max = 1e4});
  visit("start_heading_rad",
        o.start_heading_rad,
        {.help = "heading at the start, if way points are given", .min = -7, .max = 7});
  visit("start_on_route",
        o.start_on_route,
        {.help = "where along the layout's route it starts, as a share", .min = 0, .max = 0.99});
  visit("joins_at_s", o.joins_at_s, {.help = "takes no scans before", .min = 0, .max = 1e6});
  visit("tells_start", o.tells_start, {.help = "whether it says where it starts, of several"});
  visit("told_start_off_x_m",
        o.told_start_off_x_m,
        {.help = "how wrong that is, in the world", .min = -1e4, .max = 1e4});
  visit("told_start_off_y_m",
        o.told_start_off_y_m,
        {.help = "how wrong that is, in the world", .min = -1e4, .max = 1e4});
  visit("told_start_off_heading_rad",
        o.told_start_off_heading_rad,
        {.help = "how wrong that is", .min = -7, .max = 7});
  visit("carried", o.carried, {.help = "taken up and put down further on its way"});
  visit("length_m", o.length_m, {.help = "of the body", .min = 0.05, .max = 10});
  visit("width_m", o.width_m, {.help = "of the body", .min = 0.05, .max = 10});
  visit("mass_kg", o.mass_kg, {.help = "mass", .min = 0.1, .max = 1e4});
  visit("drive", o.drive, {.help = "wheels and motors"});
  visit("odometry", o.odometry, {.help = "encoders"});
  visit("gyro", o.gyro, {.help = "yaw rate sensor"});
  visit("laser", o.laser, {.help = "laser scanner"});
  visit("more_lasers", o.more_lasers, {.help = "others that it has besides, four at most"});
  visit("driver", o.driver, {.help = "who steers it, and where to"});
}

/// Whether files can be called after a robot of that name, and none outside of their folder.
bool IsFileName(const std::string& name);

template <class Report>
void Validate(const RobotOptions& o, Report& report) {
  if (!IsFileName(o.name)) {
    report("name",
           "its files are called after it: must be a text without '/' and control characters that "
           "does not begin with '.'");
  }
  if (o.more_lasers.size() > 4) report("more_lasers", "must be four at most: logs name five");
  if (o.drive.track_m > o.width_m) report("width_m", "must be at least drive.track_m");
  if (o.drive.type == DriveType::kSkidSteer && o.drive.wheelbase_m > o.length_m) {
    report("length_m", "must be at least drive.wheelbase_m");
  }
  if (!o.carried.empty() && !FollowsWaypoints(o.driver.kind)) {
    report("carried", "needs a driver that follows way points: skilled or poor");
  }
  const auto is_earlier = [](const auto& a, const auto& b) { return a.at_s < b.at_s; };
  if (!std::ranges::is_sorted(o.carried, is_earlier)) {
    report("carried", "must be in the order of its at_s");
  }
  const bool is_off = o.told_start_off_x_m != 0.0 || o.told_start_off_y_m != 0.0 ||
                      o.told_start_off_heading_rad != 0.0;
  if (is_off && !o.tells_start) report("tells_start", "must be true where what it says is off");
}

/// A scan, and what was true and what was believed when its first beam was cast.
struct Reading {
  std::size_t robot = 0;  ///< Index in the scenario.
  std::size_t laser = 0;  ///< 0, or that of more_lasers, counted from 1.
  qwsm::LaserScan scan;
  qwsm::Pose2 T_odom_robot;  ///< Pose by the wheels, from where the robot started.
  /// Pose at the last beam as seen from that at the first, by the wheels and, where there is one,
  /// the gyro.
  qwsm::Pose2 T_first_last;
  qwsm::Pose2 T_world_robot;       ///< True pose.
  std::optional<double> gyro_rad;  ///< Angle turned since the start, by the gyro; not wrapped.
  /// What the gyro felt since the robot's reading before, up to the end of this one.
  std::vector<qwsm::ImuReading> imu{};
};

/// What a mapper is told of a reading: the scan as from the place of its first beam.
qwsm::Observation ObservationOf(const Reading& reading);

/// Where a robot says that it starts, if it really starts there.
/// @pre it says that.
qwsm::Pose2 ToldStart(const RobotOptions& options, const qwsm::Pose2& T_world_start);

/// A robot, where it starts and the way it is to follow, if it follows one.
struct RobotPlacement {
  RobotOptions options;
  qwsm::Pose2 T_world_robot;
  Route route;
};

/// One robot in the world: a body pushed by its wheels, sensors, and whoever drives it.
class Robot {
 public:
  Robot(const RobotPlacement& placement, std::uint64_t seed, PhysicsWorld& world);

  /// Lets the driver decide, turns the wheels and pushes, for a step of the world that begins now.
  void Drive(PhysicsWorld& world,
             const Ground& ground,
             qwsm::Timestamp now,
             std::chrono::nanoseconds step);

  /// Reads encoders and gyro, after the step, which ends now.
  void Advance(const PhysicsWorld& world, qwsm::Timestamp now, std::chrono::nanoseconds step);

  /// Casts the beams that are due by now. @param completed takes the scans that are complete.
  void Scan(const PhysicsWorld& world, qwsm::Timestamp now, std::vector<Reading>& completed);

  Driver& driver() { return driver_; }
  const Driver& driver() const { return driver_; }
  const RobotOptions& options() const { return options_; }
  BodyId body() const { return body_; }
  const qwsm::Pose2& T_odom_robot() const { return odometry_.T_odom_robot(); }

 private:
  /// A laser, and the scan that it takes.
  struct MountedLaser {
    LaserOptions options;
    Laser laser;
    Reading reading{};
    std::int64_t scans_begun = 0;

    bool IsDue(qwsm::Timestamp now) const;
  };

  void Mount(LaserOptions options, std::uint64_t seed);
  void CarryIfDue(PhysicsWorld& world, qwsm::Timestamp now);
  void BeginScan(const PhysicsWorld& world, qwsm::Timestamp now, MountedLaser& mounted);
  void EndScan(qwsm::LaserScan scan, qwsm::Timestamp now, Reading& reading) const;
  void ReadGyro(const PhysicsWorld& world, qwsm::Timestamp now, std::chrono::nanoseconds step);

  RobotOptions options_;
  BodyId body_;
  WheelDrive drive_;
  WheelOdometry odometry_;
  Gyro gyro_;
  std::vector<qwsm::ImuReading> imu_;  // Since the last reading.
  std::vector<MountedLaser> lasers_;
  std::size_t times_carried_ = 0;
  Driver driver_;
};

}  // namespace sim
