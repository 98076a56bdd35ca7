// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

/// Random points as maps have them, and some as no map should have.
namespace qwsm::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Points = std::vector<Eigen::Vector2d>;
using Random = std::mt19937_64;

inline double Uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Eigen::Vector2d PointInSquare(Random& random,
                                     const Eigen::Vector2d& center_m,
                                     double side_m) {
  const double x_m = Uniform(random, -side_m / 2, side_m / 2);
  const double y_m = Uniform(random, -side_m / 2, side_m / 2);
  return center_m + Eigen::Vector2d(x_m, y_m);
}

/// Steps from micrometres to the whole extent, so that all levels of the tree are crossed.
inline Eigen::Vector2d AnyStep(Random& random, double extent_m) {
  const double length_m = extent_m * std::pow(10.0, Uniform(random, -6.0, 0.0));
  const double heading_rad = Uniform(random, -std::numbers::pi, std::numbers::pi);
  return length_m * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
}

/// Distributions a map may have.
inline Points Cloud(Random& random, const Eigen::Vector2d& center_m, double extent_m, int kind) {
  Points points_m;
  const auto count = static_cast<int>(Uniform(random, 1, 600));
  const Eigen::Vector2d start_m = PointInSquare(random, center_m, extent_m);
  const Eigen::Vector2d end_m = PointInSquare(random, center_m, extent_m);
  for (int i = 0; i < count; ++i) {
    switch (kind) {
      case 0:  // Anywhere.
        points_m.push_back(PointInSquare(random, center_m, extent_m));
        break;
      case 1:  // On one straight line.
        points_m.emplace_back(start_m + Uniform(random, 0, 1) * (end_m - start_m));
        break;
      case 2:  // On cell borders, at equal distances, many times the same.
        points_m.emplace_back(PointInSquare(random, center_m, extent_m) / (extent_m / 16));
        points_m.back() = points_m.back().array().round() * std::round(extent_m / 16 * 1024) / 1024;
        break;
      case 3:  // In clusters of a few cells.
        points_m.push_back(PointInSquare(random, i % 2 == 0 ? start_m : end_m, 0.02));
        break;
      default:  // Along an axis.
        points_m.emplace_back(Uniform(random, -extent_m / 2, extent_m / 2) + center_m.x(),
                              center_m.y());
    }
  }
  return points_m;
}

struct Setting {
  double extent_m;
  Eigen::Vector2d center_m;
};

inline const std::vector<Setting>& Settings() {
  static const std::vector<Setting> settings = {{1.0, {0, 0}},
                                                {30.0, {0, 0}},
                                                {10e3, {0, 0}},
                                                {1.0, {1e6, -1e6}},
                                                {100.0, {-123.456, 1e6}},
                                                {10e3, {4e5, 5.8e6}}};
  return settings;
}

}  // namespace qwsm::test
