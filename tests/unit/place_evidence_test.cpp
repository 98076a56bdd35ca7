// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/place_evidence.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// A room of 8 by 6 m, and maybe a column in it.
World RoomWith(bool has_column) {
  World room{.walls = {{.from_m = {-4.0, -3.0}, .to_m = {4.0, -3.0}},
                       {.from_m = {4.0, -3.0}, .to_m = {4.0, 3.0}},
                       {.from_m = {4.0, 3.0}, .to_m = {-4.0, 3.0}},
                       {.from_m = {-4.0, 3.0}, .to_m = {-4.0, -3.0}}},
             .columns = {}};
  if (has_column) room.columns.push_back({.center_m = {1.5, 0.0}, .radius_m = 0.3});
  return room;
}

LaserScan ScanOfRoom(const World& world, const Pose2& T_world_robot) {
  std::mt19937_64 random(3);
  return Measure({.beams = 181}, world, T_world_robot, random);
}

/// A room that was mapped by three scans, and is seen once more without the column.
MutualFit FitWhereAColumnWasSeenBy(int scans) {
  ScanMap map;
  for (int i = 0; i < 3; ++i) {
    const Pose2 T_map_robot{-0.4 * i, 0.0, 0.0};
    const LaserScan scan = ScanOfRoom(RoomWith(i < scans), T_map_robot);
    map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
  }
  const Pose2 T_map_robot{-1.0, 0.2, 0.0};
  const LaserScan scan = ScanOfRoom(RoomWith(false), T_map_robot);
  return PlaceEvidence().WeighBothWays(map, {scan, T_map_robot}, 3);
}

TEST(PlaceEvidence, IsAgainstAPlaceWhereWhatSeveralScansSawIsGone) {
  EXPECT_GT(FitWhereAColumnWasSeenBy(3).of_map.seen_through, 0.01);
}

TEST(PlaceEvidence, IsNotWhereOneScanAloneSawSomebody) {
  EXPECT_EQ(FitWhereAColumnWasSeenBy(1).of_map.seen_through, 0.0);
  EXPECT_GT(FitWhereAColumnWasSeenBy(1).Nats(), FitWhereAColumnWasSeenBy(3).Nats());
}

TEST(PlaceEvidence, OfADenseScanIsThatOfWhatLiesApart) {
  std::mt19937_64 random(3);
  const auto told = [&](std::size_t beams) {
    const SimulatedLaser laser{.beams = beams, .range_sigma_m = 0.0, .bearing_sigma_rad = 0.0};
    return PlaceEvidence::Told(ToPoints(Measure(laser, RoomWith(false), {}, random)));
  };
  EXPECT_NEAR(told(181), 181 / 3.0, 3.0);
  EXPECT_LT(told(3601), 1.1 * told(721));
}

TEST(PlaceEvidence, OfAPlaceIsAskedForTheMoreTheFartherOffTheRobotMayBe) {
  EXPECT_LT(NatsAskedOfPlace(0.1), 0.0);
  EXPECT_LT(NatsAskedOfPlace(1.0), NatsAskedOfPlace(5.0));
  EXPECT_EQ(NatsAskedOfPlace(kLookalike_m), kConvincingNats);
  EXPECT_EQ(NatsAskedOfPlace(1000.0), kConvincingNats);
}

}  // namespace
}  // namespace qwsm::test
