// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/rearranged_maps.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "service/team/atlas/team_atlas.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

TeamScan Scan(const std::string& robot, std::uint64_t sequence) {
  return {.key = {.service = "base", .robot = robot, .sequence = sequence},
          .scan = test::ObservationInRoom(static_cast<int>(10 * sequence)).scan,
          .map_robot = {.T_a_b = test::PoseInRoom(static_cast<int>(10 * sequence))},
          .T_odom_robot = {}};
}

/// Robot, sequence and x of each scan, in their order.
std::vector<std::string> ListOf(const TeamMap& map) {
  std::vector<std::string> scans;
  for (const TeamScan& scan : map.Scans()) {
    scans.push_back(scan.key.robot + " " + std::to_string(scan.key.sequence) + " " +
                    std::to_string(scan.map_robot.T_a_b.x_m));
  }
  return scans;
}

/// A team's map with scans of one robot, and a component with those of another.
class RearrangedMapsTest : public ::testing::Test {
 protected:
  RearrangedMapsTest() {
    maps_.Put("b", "b");
    for (const std::uint64_t sequence : {1, 2}) Extend("a", sequence);
    for (const std::uint64_t sequence : {1, 2}) Extend("b", sequence);
  }

  void Extend(const std::string& robot, std::uint64_t sequence) {
    const TeamScan scan = Scan(robot, sequence);
    maps_.Of(robot).map->Insert(scan, ToPoints(scan.scan));
  }
  /// All scans of b are found in the team's map, ten metres from where they are.
  Rearrangement Joined() const {
    Rearrangement joined = AsTheyAre(maps_);
    for (Placement& place : joined.wanted.at("b")) {
      place.component = "";
      place.map_robot.T_a_b.x_m += 10.0;
    }
    return joined;
  }
  static std::string Told(const std::string& robot, std::uint64_t sequence, double by_m) {
    const Pose2 T_map_robot = Scan(robot, sequence).map_robot.T_a_b;
    return robot + " " + std::to_string(sequence) + " " + std::to_string(T_map_robot.x_m + by_m);
  }

  TeamMaps maps_{MapSharing::kTeam, {}};
};

TEST_F(RearrangedMapsTest, WhatCameMeanwhileIsThereToo) {
  RearrangedMaps made;
  made.Follow(maps_, Joined());
  Extend("b", 3);
  Extend("a", 3);
  made.Follow(maps_, Joined());
  const auto maps = made.maps();
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps.at("b"), nullptr);
  EXPECT_EQ(ListOf(*maps.at("")),
            (std::vector{Told("a", 1, 0.0),
                         Told("a", 2, 0.0),
                         Told("b", 1, 10.0),
                         Told("b", 2, 10.0),
                         Told("a", 3, 0.0),
                         Told("b", 3, 10.0)}));
}

TEST_F(RearrangedMapsTest, RobotsAreAnsweredInTheOldOnesMeanwhile) {
  const std::vector<std::string> before = ListOf(*maps_.Named("").map);
  RearrangedMaps made;
  made.Follow(maps_, Joined());
  EXPECT_EQ(ListOf(*maps_.Named("").map), before);
}

// Who was matched with a map that only grows need not find its place anew.
TEST_F(RearrangedMapsTest, OnlyWhatMovesIsOfAnotherVersion) {
  RearrangedMaps made;
  made.Follow(maps_, Joined());
  EXPECT_EQ(made.maps().at("")->version(), maps_.Named("").map->version());

  Rearrangement corrected = AsTheyAre(maps_);
  corrected.wanted.at("").back().map_robot.T_a_b.y_m += 0.1;
  RearrangedMaps moved;
  moved.Follow(maps_, corrected);
  ASSERT_EQ(moved.maps().size(), 1U);
  const MapVersion before = maps_.Named("").map->version();
  EXPECT_EQ(moved.maps().at("")->version(),
            (MapVersion{.map = before.map, .epoch = before.epoch + 1}));
  EXPECT_EQ(moved.maps().at("")->Scans().back().map_robot.T_a_b.y_m,
            maps_.Named("").map->Scans().back().map_robot.T_a_b.y_m + 0.1);
}

// What is known of scans by their ids holds in the next version of a map; where some arrive while
// others move, those that came meanwhile are behind them.
TEST_F(RearrangedMapsTest, AreOtherMapsWhereScansAreRenumbered) {
  Rearrangement both = Joined();
  both.wanted.at("").back().map_robot.T_a_b.y_m += 0.1;
  RearrangedMaps made;
  made.Follow(maps_, both);
  EXPECT_NE(made.maps().at("")->version().map, maps_.Named("").map->version().map);
}

TEST_F(RearrangedMapsTest, HoldAllScansOfALargeMap) {
  for (std::uint64_t sequence = 3; sequence <= 40; ++sequence) Extend("b", sequence);
  RearrangedMaps made;
  made.Follow(maps_, Joined());
  const auto maps = made.maps();
  EXPECT_EQ(maps.at("b"), nullptr);
  std::vector<std::string> told{Told("a", 1, 0.0), Told("a", 2, 0.0)};
  for (std::uint64_t sequence = 1; sequence <= 40; ++sequence) {
    told.push_back(Told("b", sequence, 10.0));
  }
  EXPECT_EQ(ListOf(*maps.at("")), told);
}

// Who moves on to the new map would take as long as freeing the old one takes.
TEST(TeamAtlas, FreesReplacedMapsWhereNobodyWaits) {
  const SinkList<TeamSink> sinks(std::vector<TeamSink*>{});
  TeamAtlas atlas({},
                  {.service = [] { return std::string("base"); },
                   .keep = [](io::JournalEntry, const std::function<void()>& kept) { kept(); },
                   .sinks = sinks});
  for (const std::string robot : {"a", "b"}) {
    TeamScan scan = Scan(robot, 1);
    scan.component = robot == "a" ? "" : robot;
    ASSERT_TRUE(atlas.TakeIn(std::move(scan)));
  }
  const MapComponent home = atlas.maps().Named("");
  std::weak_ptr<TeamMap> into = home.map;
  std::weak_ptr<TeamMap> from = atlas.maps().Named("b").map;
  ASSERT_TRUE(atlas.Join({.from = from.lock()->version(),
                          .from_name = "b",
                          .into = into.lock()->version(),
                          .into_name = "",
                          .into_from = {}}));
  EXPECT_FALSE(from.expired());
  atlas.Tidy();
  EXPECT_TRUE(from.expired());
  EXPECT_FALSE(into.expired());  // Somebody still reads it.
}

}  // namespace
}  // namespace qwsm::team
