// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Where maps lie in each other that robots made, each alone.
#include "service/team/atlas/meeting_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::team {
namespace {

/// What a robot maps between two moments of a drive through an office, in the frame it begins in.
/// @param begun when it did; at the same time as another one if not told.
ScanMap MapOfDrive(const test::SimulatedDrive& drive,
                   std::size_t first,
                   std::size_t last,
                   Timestamp begun = {}) {
  const Pose2 T_own_world = drive.T_world_robot[first].Inverse();
  ScanMap map;
  for (std::size_t i = first; i < last; i += 5) {
    LaserScan scan = drive.observations[i].scan;
    scan.stamp += begun - drive.observations[first].scan.stamp;
    map.Insert(scan,
               ToPoints(scan),
               UncertainPose2::WithSigmas(T_own_world * drive.T_world_robot[i], 0.005, 0.002));
  }
  return map;
}

class MeetingPlaces : public testing::Test {
 protected:
  static constexpr std::size_t kScans = 120;

  ScanMap MapFrom(std::size_t first, Timestamp begun) const {
    return MapOfDrive(drive_, first, first + kScans, begun);
  }
  ScanMap MapFrom(std::size_t first) const { return MapFrom(first, std::chrono::hours(first)); }

  void ExpectToBeRight(const MeetingPlace& place, std::size_t first) const {
    const Pose2 T_truth = drive_.T_world_robot[0].Inverse() * drive_.T_world_robot[first];
    const Pose2 off = T_truth.Inverse() * place.first_map.T_a_b;
    EXPECT_LT(off.translation_m().norm(), 0.05);
    EXPECT_LT(std::abs(off.theta_rad), 0.01);
  }

  /// That of three robots the third one gets its place before the second one, and both the right
  /// one.
  void ExpectThirdBeforeSecond(std::size_t second_from, std::size_t third_from) const {
    const ScanMap first = MapFrom(0);
    const ScanMap second = MapFrom(second_from);
    const ScanMap third = MapFrom(third_from);
    const std::vector<MeetingPlace> places =
        FindMeetingPlaces(std::vector{&first, &second, &third}, {}).places;
    ASSERT_EQ(places.size(), 3U);
    EXPECT_EQ(places[1].map, 2U);
    ExpectToBeRight(places[1], third_from);
    EXPECT_EQ(places[2].map, 1U);
    ExpectToBeRight(places[2], second_from);
  }

  test::SimulatedDrive drive_ = test::DriveThrough(test::OfficeLoop(), {.scan_period_s = 0.5});
};

TEST_F(MeetingPlaces, AreWhereBothRobotsHaveBeen) {
  const ScanMap first = MapFrom(0);
  const ScanMap second = MapFrom(60);
  const MetMaps met = FindMeetingPlaces(std::vector{&first, &second}, {});
  ASSERT_EQ(met.places.size(), 2U);
  EXPECT_EQ(met.places[0].map, 0U);
  EXPECT_EQ(met.places[1].map, 1U);
  ExpectToBeRight(met.places[1], 60);
  EXPECT_EQ(met.map.scans().size(), first.scans().size() + second.scans().size());
}

// Who is where the other one is at the same time, and sees nobody, is in a place that looks alike.
TEST_F(MeetingPlaces, AreNoneWhereRobotsWouldHaveSeenEachOther) {
  constexpr std::size_t kFew = 60;  // Of much more that agrees, one is sure all the same.
  const ScanMap first = MapOfDrive(drive_, 60, 60 + kFew, std::chrono::hours(1));
  const ScanMap meanwhile = MapOfDrive(drive_, 61, 61 + kFew, std::chrono::hours(1));
  const ScanMap later = MapOfDrive(drive_, 61, 61 + kFew, std::chrono::hours(2));
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &meanwhile}, {}).places.size(), 1U);
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &later}, {}).places.size(), 2U);
}

// Two rooms that are alike are drawn by a robot each: either may be the one that the first robot
// drew, and not both.
TEST_F(MeetingPlaces, AreNoneWhereOneOfTwoRobotsIsAndNobodyKnowsWhich) {
  constexpr std::size_t kFew = 60;
  const ScanMap first = MapOfDrive(drive_, 60, 60 + kFew, std::chrono::hours(1));
  const ScanMap second = MapOfDrive(drive_, 61, 61 + kFew, std::chrono::hours(2));
  const ScanMap meanwhile = MapOfDrive(drive_, 61, 61 + kFew, std::chrono::hours(2));
  const ScanMap later = MapOfDrive(drive_, 61, 61 + kFew, std::chrono::hours(3));
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &second, &meanwhile}, {}).places.size(), 1U);
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &second, &later}, {}).places.size(), 3U);
}

TEST_F(MeetingPlaces, AreFoundByWayOfAThirdRobot) { ExpectThirdBeforeSecond(160, 80); }

// A place of which little is known is judged with what is known well.
TEST_F(MeetingPlaces, AreFirstThoseForWhichMostSpeaks) { ExpectThirdBeforeSecond(80, 20); }

// Of the first one the laser may be broken, or covered.
TEST_F(MeetingPlaces, AreInTheMapOfTheFirstRobotThatSeesAnything) {
  const ScanMap blind;
  const ScanMap second = MapFrom(0);
  const ScanMap third = MapFrom(60);
  const MetMaps met = FindMeetingPlaces(std::vector{&blind, &blind, &second, &third, &blind}, {});
  ASSERT_EQ(met.places.size(), 2U);
  EXPECT_EQ(met.places[0].map, 2U);
  EXPECT_EQ(met.places[1].map, 3U);
  ExpectToBeRight(met.places[1], 60);
  EXPECT_EQ(met.map.scans().size(), second.scans().size() + third.scans().size());
}

TEST_F(MeetingPlaces, AreNoneWhereRobotsNeverMet) {
  const test::SimulatedDrive elsewhere =
      test::DriveThrough(test::FurnishedRoom(), {.scan_period_s = 0.5});
  const ScanMap first = MapFrom(0);
  const ScanMap other = MapOfDrive(elsewhere, 0, std::min(kScans, elsewhere.observations.size()));
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &other}, {}).places.size(), 1U);
}

TEST_F(MeetingPlaces, AreThoseFoundUntilItIsStopped) {
  const ScanMap first = MapFrom(0);
  const ScanMap second = MapFrom(60);
  const auto stop = [] { return true; };
  EXPECT_EQ(FindMeetingPlaces(std::vector{&first, &second}, {}, stop).places.size(), 1U);
}

TEST_F(MeetingPlaces, AreNoneWithoutMaps) {
  const ScanMap one = MapFrom(0);
  const ScanMap empty;
  EXPECT_TRUE(FindMeetingPlaces({}, {}).places.empty());
  EXPECT_EQ(FindMeetingPlaces(std::vector{&one, &empty}, {}).places.size(), 1U);
  EXPECT_EQ(FindMeetingPlaces(std::vector{&empty, &one}, {}).places.size(), 1U);
  EXPECT_EQ(FindMeetingPlaces(std::vector{&empty, &empty}, {}).places.size(), 1U);
}

}  // namespace
}  // namespace qwsm::team
