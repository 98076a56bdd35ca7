// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

/// A building of any size, as a robot's laser would have sampled it.
namespace qwsm::bench {

using Points = std::vector<Eigen::Vector2d>;
using Random = std::mt19937_64;

inline constexpr double kRoomX_m = 5.0;
inline constexpr double kRoomY_m = 4.0;
inline constexpr double kRangeSigma_m = 0.01;

inline double Uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Eigen::Vector2d Noise(Random& random, double sigma_m) {
  std::normal_distribution<double> normal(0.0, sigma_m);
  const double x_m = normal(random);
  return {x_m, normal(random)};
}

/// Distance from a place inside a room about the origin to its wall.
inline double RangeInRoom_m(const Eigen::Vector2d& from_m, double bearing_rad) {
  const Eigen::Vector2d ray(std::cos(bearing_rad), std::sin(bearing_rad));
  const double x_m = ((ray.x() > 0.0 ? 0.5 : -0.5) * kRoomX_m - from_m.x()) / ray.x();
  const double y_m = ((ray.y() > 0.0 ? 0.5 : -0.5) * kRoomY_m - from_m.y()) / ray.y();
  return std::min(std::abs(x_m), std::abs(y_m));
}

/// Rooms of 5 m by 4 m in a square grid, each a third of a metre from the next.
class Building {
 public:
  /// As many rooms as hold `points` with this many of them in each.
  Building(std::size_t points, std::size_t points_per_room)
      : points_per_room_(points_per_room),
        rooms_((points + points_per_room - 1) / points_per_room),
        columns_(static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(rooms_))))) {}

  std::size_t rooms() const { return rooms_; }

  Eigen::Vector2d Middle_m(std::size_t room) const {
    return {static_cast<double>(room % columns_) * (kRoomX_m + 1.0 / 3.0),
            static_cast<double>(room / columns_) * (kRoomY_m + 1.0 / 3.0)};
  }

  /// What was stored: noisy samples of all walls, room by room in random order.
  Points Sampled(Random& random) const {
    std::vector<std::size_t> order(rooms_);
    for (std::size_t i = 0; i < rooms_; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    Points points_m;
    points_m.reserve(rooms_ * points_per_room_);
    const double perimeter_m = 2.0 * (kRoomX_m + kRoomY_m);
    for (const std::size_t room : order) {
      for (std::size_t i = 0; i < points_per_room_; ++i) {
        const double along_m =
            perimeter_m * static_cast<double>(i) / static_cast<double>(points_per_room_);
        points_m.push_back(Middle_m(room) + OnWall_m(along_m) + Noise(random, kRangeSigma_m));
      }
    }
    return points_m;
  }

 private:
  /// A place on the walls of a room about the origin.
  static Eigen::Vector2d OnWall_m(double along_m) {
    const double half_x_m = 0.5 * kRoomX_m;
    const double half_y_m = 0.5 * kRoomY_m;
    if (along_m < kRoomX_m) return {along_m - half_x_m, -half_y_m};
    along_m -= kRoomX_m;
    if (along_m < kRoomY_m) return {half_x_m, along_m - half_y_m};
    along_m -= kRoomY_m;
    if (along_m < kRoomX_m) return {half_x_m - along_m, half_y_m};
    return {-half_x_m, half_y_m - (along_m - kRoomX_m)};
  }

  std::size_t points_per_room_;
  std::size_t rooms_;
  std::size_t columns_;
};

/// A place to stand in one of the rooms.
struct Standpoint {
  Eigen::Vector2d middle_m;  ///< Of the room.
  Pose2 T_room_robot;

  Pose2 T_map_robot() const { return Pose2{middle_m.x(), middle_m.y(), 0.0} * T_room_robot; }
};

inline Standpoint AnyStandpoint(const Building& building, Random& random) {
  const auto room = static_cast<std::size_t>(random() % building.rooms());
  return {building.Middle_m(room),
          {Uniform(random, -1.5, 1.5), Uniform(random, -1.0, 1.0), Uniform(random, -3.1, 3.1)}};
}

/// What a laser that looks ahead measures there.
inline LaserScan ScanFrom(const Standpoint& standpoint, std::size_t beams, Random& random) {
  constexpr double kPi = std::numbers::pi;
  LaserScan scan;
  scan.geometry.first_bearing_rad = static_cast<float>(-0.5 * kPi);
  scan.geometry.bearing_step_rad = static_cast<float>(kPi / static_cast<double>(beams - 1));
  scan.geometry.range_max_m = 30.0F;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const Pose2& T_room_robot = standpoint.T_room_robot;
    const double range_m = RangeInRoom_m(T_room_robot.translation_m(),
                                         scan.geometry.Bearing(beam) + T_room_robot.theta_rad);
    scan.ranges_m.push_back(static_cast<float>(range_m + Noise(random, kRangeSigma_m).x()));
  }
  return scan;
}

}  // namespace qwsm::bench
