// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "qwsm/sensor/scan_points.hpp"

namespace qwsm::test {
namespace {

/// Walls at any range, with steps, gaps and single objects; beams are missing here and there.
LaserScan AnyScan(std::mt19937_64& random) {
  std::uniform_real_distribution<float> any(0.0F, 1.0F);
  LaserScan scan;
  scan.geometry = {.first_bearing_rad = -1.5F,
                   .bearing_step_rad = any(random) < 0.5F ? 0.0087F : -0.0175F,
                   .range_min_m = 0.1F,
                   .range_max_m = 20.0F,
                   .T_robot_laser = {0.2, -0.1, 0.4}};
  float wall_m = 0.3F + 5.0F * any(random);
  for (int beam = 0; beam < 200; ++beam) {
    const float event = any(random);
    if (event < 0.05F) wall_m = 0.3F + 5.0F * any(random);
    float range_m = wall_m + 0.02F * any(random);
    if (event > 0.95F) range_m *= 0.5F + any(random);
    if (event > 0.9F && event < 0.93F) range_m = std::numeric_limits<float>::quiet_NaN();
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

/// Mean of the neighbours of one surface within reach, as its definition has it.
Eigen::Vector2d ToMeanWithin(double reach_m,
                             const std::vector<ScanPoint>& points,
                             std::size_t center) {
  const ScanPoint& point = points[center];
  const double gap_m = std::max(0.03, 3.0 * point.arc_m);
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  int count = 1;
  for (const int step : {-1, 1}) {
    std::size_t last = center;
    for (std::size_t i = center + static_cast<std::size_t>(step); i < points.size();
         i += static_cast<std::size_t>(step)) {
      const Eigen::Vector2d offset = points[i].p_robot_m - point.p_robot_m;
      if (offset.norm() > reach_m) break;
      if ((points[i].p_robot_m - points[last].p_robot_m).norm() > gap_m) break;
      sum_m += offset;
      ++count;
      last = i;
    }
  }
  return sum_m / count;
}

TEST(ScanSurface, MeansAreOfTheNeighborsOfOneSurface) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const std::vector<ScanPoint> points = ToPoints(AnyScan(random));
    ASSERT_GT(points.size(), 150U);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d to_mean_m = ToMeanWithin(kSurfaceReach_m, points, i);
      const Eigen::Vector2d to_mean_near_m = ToMeanWithin(0.5 * kSurfaceReach_m, points, i);
      EXPECT_LT((points[i].to_mean_robot_m - to_mean_m).norm(), 1e-12) << i;
      EXPECT_LT((points[i].to_mean_near_robot_m - to_mean_near_m).norm(), 1e-12) << i;
    }
  }
}

TEST(ScanSurface, NormalsAreUnitVectorsTowardsTheLaserOrNone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::size_t lines = 0;
    const std::vector<ScanPoint> points = ToPoints(AnyScan(random));
    for (const ScanPoint& point : points) {
      EXPECT_GE(point.spacing_m, point.arc_m);
      if (point.normal_robot.isZero()) continue;
      ++lines;
      EXPECT_NEAR(point.normal_robot.norm(), 1.0, 1e-9);
      EXPECT_LE(point.normal_robot.dot(point.beam_robot), 0.0);
    }
    EXPECT_GT(lines, points.size() / 3);
  }
}

}  // namespace
}  // namespace qwsm::test
