// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/surface_hold.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

// What a laser that looks along x from the origin sees of walls from corner to corner.
double HoldOf(const std::vector<Eigen::Vector2d>& corners_m) {
  World world;
  for (std::size_t i = 1; i < corners_m.size(); ++i) {
    world.walls.push_back({.from_m = corners_m[i - 1], .to_m = corners_m[i]});
  }
  std::mt19937_64 random(1);
  return PointsHoldingWithoutAnySurface(
      ThinOut(ToPoints(Measure({.beams = 181}, world, {}, random)), 0.15));
}

TEST(SurfaceHold, IsNothingWithoutPoints) { EXPECT_EQ(PointsHoldingWithoutAnySurface({}), 0.0); }

TEST(SurfaceHold, IsNextToNothingAtTheEndOfACorridor) {
  EXPECT_LT(HoldOf({{-5, -1}, {4, -1}, {4, 1}, {-5, 1}}), 4.0);
}

// Niches on both sides tell how far along the corridor one is, whatever its end is like.
TEST(SurfaceHold, IsMuchWhereSeveralSurfacesFaceTheRobot) {
  EXPECT_GT(HoldOf({{-5, -1}, {2, -1}, {2, -3}, {4, -3}, {4, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}}),
            8.0);
}

}  // namespace
}  // namespace qwsm::test
