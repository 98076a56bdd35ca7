// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_merger.hpp"

#include <gtest/gtest.h>

#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

void InsertScan(ScanMap& map, int scan) {
  const Observation observation = test::ObservationInRoom(scan);
  map.Insert(observation.scan, ToPoints(observation.scan), {.T_a_b = test::PoseInRoom(scan)});
}

// A search of its own for every robot in every map would need as many areas.
TEST(MapMerger, SearchesOfOneMapShareItsAreaAndFindTheSame) {
  ScanMap map;
  for (int scan = 0; scan < 120; scan += 10) InsertScan(map, scan);
  MappedArea area;
  const ModeSearchArea* const made = &area.Of(map);
  for (const int first : {15, 45}) {
    PlaceFinder sharing;
    PlaceFinder alone;
    for (int scan = first; scan < first + 40; scan += 5) {
      const auto points = ToPoints(test::ObservationInRoom(scan).scan);
      const PlaceBelief& shared = sharing.Look(map, area, points, test::PoseInRoom(scan));
      const PlaceBelief& own = alone.Look(map, points, test::PoseInRoom(scan));
      ASSERT_EQ(shared.places.size(), own.places.size());
      ASSERT_FALSE(own.places.empty());
      EXPECT_EQ(shared.places.front().map_robot.T_a_b, own.places.front().map_robot.T_a_b);
      EXPECT_EQ(shared.places.front().probability, own.places.front().probability);
    }
  }
  EXPECT_EQ(&area.Of(map), made);
  InsertScan(map, 125);
  area.Of(map);
  EXPECT_EQ(area.path_m().size(), map.scans().size());
}

}  // namespace
}  // namespace qwsm::team
