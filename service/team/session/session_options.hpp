// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace qwsm::team {

/// Where a robot starts in the map.
struct RobotStartOptions {
  std::string name = "robot1";
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double sigma_m = 0.1;
  double sigma_rad = 0.05;
};

template <class Visitor>
void Describe(Visitor& visit, RobotStartOptions& o) {
  visit("name", o.name, {.help = "of the robot: its namespace"});
  visit("x_m", o.x_m, {.help = "where it starts", .min = -1e4, .max = 1e4});
  visit("y_m", o.y_m, {.help = "where it starts", .min = -1e4, .max = 1e4});
  visit("heading_rad", o.heading_rad, {.help = "heading at the start", .min = -7, .max = 7});
  visit("sigma_m", o.sigma_m, {.help = "how far off that may be", .min = 0, .max = 10});
  visit("sigma_rad", o.sigma_rad, {.help = "how far off the heading may be", .min = 0, .max = 3.2});
}

/// Options of how one robot is listened to.
struct SessionOptions {
  int queue_scans = 4;
  int max_readings = 5000;
  double odometry_wait_s = 0.05;
  bool deskew = true;
  double laser_height_m = 0.0;
  double max_speed_mps = 5.0;
  double max_turn_rate_radps = 10.0;
};

template <class Visitor>
void Describe(Visitor& visit, SessionOptions& o) {
  visit("queue_scans",
        o.queue_scans,
        {.help = "scans of a robot that may wait; then the oldest is dropped",
         .min = 1,
         .max = 100000});
  visit("max_readings",
        o.max_readings,
        {.help = "of a scan with more beams, or points, no more than so many are used, evenly",
         .min = 100,
         .max = 20'000'000});
  visit("odometry_wait_s",
        o.odometry_wait_s,
        {.help = "how long a scan waits for the odometry, and the gyro, of its moment",
         .min = 0,
         .max = 10});
  visit("deskew",
        o.deskew,
        {.help = "beams whose messages have times are put where they were measured, by odometry"});
  visit("laser_height_m",
        o.laser_height_m,
        {.help = "above the floor: beams of a robot that leans, by its imu, and sees the floor are "
                 "left out; 0: as /tf_static tells",
         .min = 0,
         .max = 10});
  visit("max_speed_mps",
        o.max_speed_mps,
        {.help = "odometry that moves faster has jumped", .min = 0.01, .max = 1000});
  visit("max_turn_rate_radps",
        o.max_turn_rate_radps,
        {.help = "odometry that turns faster has jumped", .min = 0.01, .max = 1000});
}

}  // namespace qwsm::team
