// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/team_atlas.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

TeamScan ScanOf(const std::string& service, const std::string& robot, std::uint64_t sequence) {
  const int scan = static_cast<int>(10 * sequence);
  return {.key = {.service = service, .robot = robot, .sequence = sequence},
          .scan = test::ObservationInRoom(scan).scan,
          .map_robot = {.T_a_b = test::PoseInRoom(scan)},
          .T_odom_robot = {}};
}

/// An atlas that keeps nothing and tells nobody.
class TeamAtlasTest : public ::testing::Test {
 protected:
  bool Extend(const std::string& robot, std::uint64_t sequence) {
    const TeamScan scan = ScanOf("here", robot, sequence);
    const MapVersion version = atlas_.maps().Of(robot).map->version();
    return atlas_.Extend(scan, ToPoints(scan.scan), version);
  }
  bool Part(const std::string& robot) {
    const MapComponent from = atlas_.maps().Of(robot);
    return atlas_.Part(robot, from.map->version(), from.name);
  }
  bool Join(const std::string& from, const std::string& into, const Pose2& T_into_from) {
    return atlas_.Join({.from = atlas_.maps().Named(from).map->version(),
                        .from_name = from,
                        .into = atlas_.maps().Named(into).map->version(),
                        .into_name = into,
                        .into_from = {.T_a_b = T_into_from}});
  }
  std::size_t CountIn(const std::string& component) {
    return atlas_.maps().Named(component).map->Scans().size();
  }

  const SinkList<TeamSink> sinks_{std::vector<TeamSink*>{}};
  TeamAtlas atlas_{{},
                   {.service = [] { return std::string("here"); },
                    .keep = [](io::JournalEntry, const std::function<void()>& kept) { kept(); },
                    .sinks = sinks_}};
};

// The last scan of the map is of the robot that leaves it.
TEST_F(TeamAtlasTest, WhatOthersHaveMappedStaysWhenARobotIsTakenOut) {
  ASSERT_TRUE(Extend("a", 1));
  ASSERT_TRUE(Extend("b", 2));
  ASSERT_TRUE(Part("b"));
  EXPECT_TRUE(atlas_.TakeIn(ScanOf("there", "c", 1)));
  EXPECT_EQ(atlas_.maps().NameOf("c"), "");
  ASSERT_TRUE(Join("b", "", {}));
  EXPECT_TRUE(atlas_.TakeIn(ScanOf("there", "c", 2)));
  EXPECT_EQ(CountIn(""), 4U);
}

// As another service may still tell of it.
TEST_F(TeamAtlasTest, ScansOfWhatHasBecomePartOfAnotherComponentAreThere) {
  ASSERT_TRUE(Extend("a", 1));
  for (const std::string robot : {"b", "c"}) {
    TeamScan scan = ScanOf("there", robot, 1);
    scan.component = robot;
    ASSERT_TRUE(atlas_.TakeIn(scan));
  }
  ASSERT_TRUE(Join("c", "b", {.x_m = 1.0}));
  ASSERT_TRUE(Join("b", "", {.y_m = 2.0}));
  TeamScan late = ScanOf("there", "c", 2);
  late.component = "c";
  ASSERT_TRUE(atlas_.TakeIn(late));
  EXPECT_EQ(CountIn(""), 4U);
  const Pose2 T_map_robot = atlas_.maps().Named("").map->LastOf("c")->map_robot.T_a_b;
  EXPECT_NEAR(T_map_robot.x_m, late.map_robot.T_a_b.x_m + 1.0, 1e-9);
  EXPECT_NEAR(T_map_robot.y_m, late.map_robot.T_a_b.y_m + 2.0, 1e-9);
}

TEST_F(TeamAtlasTest, AnAttemptThatFailsCostsNoName) {
  ASSERT_TRUE(Extend("a", 1));
  ASSERT_TRUE(Extend("b", 2));
  const MapVersion outdated{.map = 0, .epoch = 0};
  EXPECT_FALSE(atlas_.Part("b", outdated, ""));
  ASSERT_TRUE(Part("b"));
  EXPECT_EQ(atlas_.maps().NameOf("b"), "b");
}

}  // namespace
}  // namespace qwsm::team
