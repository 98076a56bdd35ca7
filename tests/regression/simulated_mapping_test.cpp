// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the mapper makes of simulated places, against the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "tests/support/mapped_drive.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

/// 60 m of straight walls along x with one door at 30 m, there and back, and a laser that sees 8 m.
sim::ScenarioOptions FeaturelessCorridor(int seed) {
  sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kCorridor, seed);
  scenario.layout.corridor.zigzag_legs = 0;
  scenario.layout.corridor.straight_m = 60.0;
  scenario.layout.corridor.door_at_m = 30.0;
  scenario.robots[0].laser.rate_hz = 5.0;
  scenario.robots[0].laser.useful_range_m = 8.0;
  return scenario;
}

/// Standard deviation along the corridor where the robot passes this x on its way out or back.
double SigmaAlongAt_m(const MappedDrive& drive, double x_m, bool on_the_way_back) {
  const auto passes = [&](const FoundPose& pose) { return pose.T_map_true.x_m > x_m; };
  const auto& poses = drive.poses();
  const FoundPose& pose = on_the_way_back ? *std::find_if(poses.rbegin(), poses.rend(), passes)
                                          : *std::ranges::find_if(poses, passes);
  return std::sqrt(pose.map_robot.covariance(0, 0));
}

TEST(SimulatedCorridor, UncertaintyAlongItGrowsHonestlyAndIsRecoveredAtTheDoor) {
  for (int seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const MappedDrive drive(FeaturelessCorridor(seed));
    // Independent errors: with the root of the way.
    EXPECT_GT(SigmaAlongAt_m(drive, 25.0, false), 1.5 * SigmaAlongAt_m(drive, 6.0, false));
    // The door is mapped as uncertainly as it was reached. Beyond it nothing is in view again.
    const double beyond_m = SigmaAlongAt_m(drive, 40.0, true);
    const double at_door_m = SigmaAlongAt_m(drive, 28.0, true);
    EXPECT_GT(beyond_m, 1.2 * SigmaAlongAt_m(drive, 31.0, false));
    EXPECT_LT(at_door_m, 0.9 * beyond_m);
    EXPECT_LT(at_door_m, 1.2 * SigmaAlongAt_m(drive, 31.0, false));
    for (const FoundPose& pose : drive.poses()) {
      const double error_m = pose.map_robot.T_a_b.x_m - pose.T_map_true.x_m;
      ASSERT_LE(std::abs(error_m), 0.02 + 4.0 * std::sqrt(pose.map_robot.covariance(0, 0)))
          << "at " << pose.T_map_true.x_m << " m";
    }
  }
}

TEST(SimulatedCorridor, ErrorAlongItIsAsLargeAsIsSaid) {
  constexpr int kDrives = 40;
  double nees = 0.0;  // Of x alone, where each drive ends; 1 is right.
  for (int seed = 1; seed <= kDrives; ++seed) {
    const MappedDrive drive(FeaturelessCorridor(seed));
    const FoundPose& last = drive.poses().back();
    const double error_m = last.map_robot.T_a_b.x_m - last.T_map_true.x_m;
    nees += error_m * error_m / last.map_robot.covariance(0, 0) / kDrives;
  }
  EXPECT_GT(nees, 0.3);
  EXPECT_LT(nees, 2.0);
}

sim::ScenarioOptions Office(int persons, int seed) {
  sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
  scenario.layout.office.persons = persons;
  scenario.robots[0].laser.rate_hz = 10.0;
  scenario.robots[0].laser.useful_range_m = 30.0;
  return scenario;
}

/// Cells of the drawn map, and those of them that are occupied where nothing stands.
struct DrawnCells {
  int occupied = 0;
  int ghosts = 0;
};

DrawnCells Count(const MappedDrive& drive) {
  constexpr double kTolerance_m = 0.15;  // Three cells.
  sim::SceneryOptions standing = drive.scenery();
  standing.persons.clear();
  sim::PhysicsWorld world;
  sim::Build(standing, world);
  const OccupancyGridResult drawn = RenderOccupancyGrid(drive.map().scans());
  DrawnCells count;
  for (int y = 0; y < drawn.grid.height; ++y) {
    for (int x = 0; x < drawn.grid.width; ++x) {
      if (drawn.grid.At(x, y) != CellState::kOccupied) continue;
      ++count.occupied;
      const Eigen::Vector2d p_map =
          drawn.grid.origin_map_m + drawn.grid.cell_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      const Eigen::Vector2d p_world = drive.T_world_map() * p_map;
      const Pose2 T_world_cell{p_world.x(), p_world.y(), 0.0};
      if (!world.IsOccupied(sim::Disc{kTolerance_m}, T_world_cell)) ++count.ghosts;
    }
  }
  return count;
}

TEST(SimulatedOffice, PeopleCostLittleAndLeaveNoGhosts) {
  constexpr int kSeeds = 10;
  double with_m = 0.0;
  double without_m = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const MappedDrive with_people(Office(3, seed));
    const MappedDrive without_people(Office(0, seed));
    with_m += with_people.AteRmse_m();
    without_m += without_people.AteRmse_m();
    const DrawnCells with = Count(with_people);
    const DrawnCells without = Count(without_people);
    ASSERT_GT(without.occupied, 1000);
    EXPECT_LE(without.ghosts, without.occupied / 100);
    EXPECT_LE(with.ghosts, with.occupied / 100) << "without people " << without.ghosts;
  }
  EXPECT_LT(with_m, 1.2 * without_m);
}

}  // namespace
}  // namespace qwsm::test
