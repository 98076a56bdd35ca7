// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/ground.hpp"

namespace sim {
namespace {

TEST(Ground, LaterRegionsLieOnTopOfEarlierOnes) {
  GroundOptions options;
  options.grass.patchiness = 0.0;
  options.regions = {{Surface::kGrass, 0.0, 0.0, 10.0, 10.0},
                     {Surface::kFloor, 4.0, 4.0, 6.0, 6.0}};
  const Ground ground(options, 1);
  EXPECT_EQ(ground.At({-1.0, 5.0}).traction, options.floor.traction);
  EXPECT_EQ(ground.At({1.0, 1.0}).traction, options.grass.traction);
  EXPECT_EQ(ground.At({5.0, 5.0}).traction, options.floor.traction);
}

TEST(Ground, PatchesStayWhereTheyAreAndDifferBetweenSeeds) {
  GroundOptions options;
  options.everywhere = Surface::kGrass;
  const Ground ground(options, 1);
  const Ground same(options, 1);
  const Ground other(options, 2);
  int different = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d p_m(-20.0 + 0.37 * i, 13.0 - 0.71 * i);
    EXPECT_EQ(ground.At(p_m).traction, same.At(p_m).traction);
    different += ground.At(p_m).traction != other.At(p_m).traction ? 1 : 0;
  }
  EXPECT_GT(different, 95);
}

TEST(Ground, PatchinessBoundsTheChangeOfFriction) {
  GroundOptions options;
  options.everywhere = Surface::kGrass;
  options.grass.patchiness = 0.3;
  const Ground ground(options, 3);
  double least = 1e9;
  double most = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const SurfaceOptions surface = ground.At({0.13 * (i % 100), 0.17 * (i / 100)});
    EXPECT_NEAR(
        surface.lateral / surface.traction, options.grass.lateral / options.grass.traction, 1e-12);
    least = std::min(least, surface.traction / options.grass.traction);
    most = std::max(most, surface.traction / options.grass.traction);
  }
  EXPECT_GE(least, 0.7);
  EXPECT_LE(most, 1.3);
  EXPECT_LT(least, 0.8) << "some places are slippery";
  EXPECT_GT(most, 1.2) << "some have grip";
}

}  // namespace
}  // namespace sim
