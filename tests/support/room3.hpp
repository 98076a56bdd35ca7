// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d {

inline Eigen::Vector3d DrawNormal(std::mt19937& random, double sigma) {
  std::normal_distribution<double> coordinate(0.0, sigma);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return {x, y, coordinate(random)};
}

/// A point of a room of 8 x 6 x 3 m with a cupboard and an oblique roof; `where` in [0, 1)^2.
inline Eigen::Vector3d RoomPoint(int wall, double u, double v) {
  switch (wall) {
    case 0:
      return {8.0 * u - 4.0, 6.0 * v - 3.0, 0.0};
    case 1:
      return {-4.0, 6.0 * u - 3.0, 3.0 * v};
    case 2:
      return {4.0, 6.0 * u - 3.0, 2.0 * v};
    case 3:
      return {8.0 * u - 4.0, -3.0, 2.5 * v};
    case 4:
      return {8.0 * u - 4.0, 3.0, 2.5 * v};
    case 5:
      return {1.0 + u, 1.5, 2.0 * v};
    case 6:
      return {1.0, 1.5 + 1.5 * u, 2.0 * v};
    default:
      return {8.0 * u - 4.0, 6.0 * v - 3.0, 3.0 - u};
  }
}

/// A scan of the room from a pose: other points of the same surfaces for every seed.
inline PointCloud ScanRoom(const Pose3& T_room_scanner, int points, double noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::uniform_int_distribution<int> wall(0, 7);
  const Pose3 T_scanner_room = T_room_scanner.Inverse();
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const int which = wall(random);
    const double u = share(random);
    const double v = share(random);
    cloud.push_back(T_scanner_room * RoomPoint(which, u, v) + DrawNormal(random, noise_m));
  }
  return cloud;
}

}  // namespace slam6d
