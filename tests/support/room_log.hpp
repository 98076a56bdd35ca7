// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <random>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm::test {

/// A wall along an axis, or not.
struct RoomWall {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

/// Distance along a ray to the nearest wall of a room of 10 x 6 m with a box in it.
inline double RangeInRoom_m(const Eigen::Vector2d& origin_m, double bearing_rad) {
  static const std::array<RoomWall, 8> kWalls{{{{-5, -3}, {5, -3}},
                                           {{5, -3}, {5, 3}},
                                           {{5, 3}, {-5, 3}},
                                           {{-5, 3}, {-5, -3}},
                                           {{2, -2}, {3, -2}},
                                           {{3, -2}, {3, -1}},
                                           {{3, -1}, {2, -1}},
                                           {{2, -1}, {2, -2}}}};
  const Eigen::Vector2d ray(std::cos(bearing_rad), std::sin(bearing_rad));
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  double nearest_m = 80.0;
  for (const RoomWall& wall : kWalls) {
    const Eigen::Vector2d along = wall.to_m - wall.from_m;
    const double sine = cross(ray, along);
    if (std::abs(sine) < 1e-12) continue;
    const double range_m = cross(wall.from_m - origin_m, along) / sine;
    const double share = cross(wall.from_m - origin_m, ray) / sine;
    if (range_m > 0.0 && share >= 0.0 && share <= 1.0) nearest_m = std::min(nearest_m, range_m);
  }
  return nearest_m;
}

/// True pose at a scan: an ellipse around the middle of the room.
inline Pose2 PoseInRoom(int scan) {
  const double phase_rad = 0.05 * scan;
  return {2.0 * std::cos(phase_rad) - 1.0,
          1.5 * std::sin(phase_rad),
          NormalizeAngle(std::atan2(1.5 * std::cos(phase_rad), -2.0 * std::sin(phase_rad)))};
}

/// Writes a CARMEN log of a drive through the room, 10 scans per second, 1 cm of noise, with an
/// odometry that turns a little too far.
inline void WriteRoomLog(const std::filesystem::path& file, int scans) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise_m(0.0, 0.01);
  std::ofstream log(file);
  log << std::fixed << std::setprecision(6);
  const Pose2 T_world_start = PoseInRoom(0);
  for (int scan = 0; scan < scans; ++scan) {
    const Pose2 T_world_robot = PoseInRoom(scan);
    Pose2 T_odom_robot = T_world_start.Inverse() * T_world_robot;
    T_odom_robot = Pose2{0.0, 0.0, 0.0002 * scan} * T_odom_robot;
    const double stamp_s = 1000.0 + 0.1 * scan;
    log << "FLASER 181";
    for (int beam = 0; beam <= 180; ++beam) {
      const double bearing_rad = DegreesToRadians(beam - 90.0) + T_world_robot.theta_rad;
      log << ' ' << RangeInRoom_m(T_world_robot.translation_m(), bearing_rad) + noise_m(random);
    }
    for (int repeat = 0; repeat < 2; ++repeat) {
      log << ' ' << T_odom_robot.x_m << ' ' << T_odom_robot.y_m << ' ' << T_odom_robot.theta_rad;
    }
    log << ' ' << stamp_s << " robot " << stamp_s << '\n';
  }
}

}  // namespace qwsm::test
