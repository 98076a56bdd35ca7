// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a registration promises is kept: pairs of scans that overlap little, in all kinds of places.
#include <gtest/gtest.h>

#include "slam6d/graph/ceres_loop_closer.hpp"
#include "slam6d/mapping/slam.hpp"
#include "tests/support/stops3.hpp"

namespace slam6d::test {
namespace {

/// How a pair was registered: its error over its covariance, or nothing where it was not believed.
std::optional<double> NeesOfPair(const Stops3& stops) {
  const PathLoopCloser closer;
  Slam slam({}, closer);
  static_cast<void>(slam.Add(stops.scans[0], stops.T_odom_scan[0]));
  const SlamStep step = slam.Add(stops.scans[1], stops.T_odom_scan[1]);
  if (step.status != SlamStatus::kMatched) return std::nullopt;
  return NeesOf(step.T_map_scan, step.covariance, stops.T_world_scan[1]);
}

// A false hold of single pairs along a street made this 12 000 for one, and 400 in the mean.
TEST(Covariance3, PredictsTheErrorOfScansThatOverlapLittle) {
  constexpr std::uint64_t kFirst = 1025;
  constexpr int kPairs = 30;
  double sum = 0.0;
  int believed = 0;
  for (int i = 0; i < kPairs; ++i) {
    const auto kind = static_cast<PlaceKind>(i % static_cast<int>(kPlaceNames.size()));
    const std::optional<ScanPair3> pair =
        DrawPair(kind, kFirst + static_cast<std::uint64_t>(i), 0.05, 0.6);
    ASSERT_TRUE(pair);
    const std::optional<double> nees = NeesOfPair(pair->stops);
    if (!nees) continue;
    EXPECT_LT(*nees, 30.0) << "pair " << i;
    sum += *nees;
    ++believed;
  }
  EXPECT_GE(believed, kPairs - 2);
  EXPECT_GT(sum / believed, 0.4);
  EXPECT_LT(sum / believed, 2.0);
}

// What the pairs leave open moves the scan in other directions, too, and a few trees that agree are
// no proof: these were 28, 53 and 70, and six degrees of freedom ask for 6. Trees still agree more
// than they should. In the third street and the office, 10 and 10, two clusters hold the way along
// a wall as much as noise may by chance. In the two corridors, 8 and 7, the way leads 1.3 and 1.5 m
// up or down, of which odometry in the plane knows nothing, and hardly the same ground is seen from
// both ends.
TEST(Covariance3, KnowsWhatOpenMotionsAndFewThingsLeaveUnknown) {
  struct Drawn {
    PlaceKind kind;
    std::uint64_t seed;
    double most_nees;
  };
  for (const Drawn drawn : {Drawn{PlaceKind::kStreets, 1022, 10.0},
                            Drawn{PlaceKind::kStreets, 1190, 10.0},
                            Drawn{PlaceKind::kStreets, 3184, 6.0},
                            Drawn{PlaceKind::kOffice, 3392, 6.0},
                            Drawn{PlaceKind::kPark, 1143, 35.0},
                            Drawn{PlaceKind::kCorridor, 2045, 6.0},
                            Drawn{PlaceKind::kCorridor, 3207, 6.0}}) {
    SCOPED_TRACE(drawn.seed);
    const std::optional<ScanPair3> pair = DrawPair(drawn.kind, drawn.seed, 0.05, 0.6);
    ASSERT_TRUE(pair);
    const std::optional<double> nees = NeesOfPair(pair->stops);
    ASSERT_TRUE(nees);
    EXPECT_LT(*nees, drawn.most_nees);
  }
}

// A scan that could lie anywhere along a street was found 1.2 m off where its pairs never settled,
// and was said to be known to 2 cm there: 200. From the guess it ended near the true pose.
TEST(Covariance3, KnowsThatPairsThatNeverSettleMayBeOfAWrongPlace) {
  const Stops3 stops = DriveAlong(PlaceKind::kStreets, 6, 12, 1.5);
  const PathLoopCloser closer;
  Slam slam({}, closer);
  for (std::size_t i = 0; i < 6; ++i) {
    const SlamStep step = slam.Add(stops.scans[i], stops.T_odom_scan[i]);
    if (i == 0) continue;
    EXPECT_LT(NeesOf(step.T_map_scan, step.covariance, stops.T_world_scan[i]), 30.0);
  }
}

// A scan's pose is a mean of what three others say, and loops are closed: as if every scan hung on
// the one before alone, this was 0.3 to 0.4.
TEST(Covariance3, PredictsTheErrorOfADriveInALoop) {
  constexpr std::uint64_t kLoops = 2;
  const graph::CeresLoopCloser closer;
  double sum = 0.0;
  int poses = 0;
  for (std::uint64_t seed = 1; seed <= kLoops; ++seed) {
    const Stops3 stops = LoopInYard(seed);
    Slam slam({}, closer);
    for (std::size_t i = 0; i < stops.scans.size(); ++i) {
      const SlamStep step = slam.Add(stops.scans[i], stops.T_odom_scan[i]);
      if (i == 0) continue;
      sum += NeesOf(step.T_map_scan, step.covariance, stops.T_world_scan[i]);
      ++poses;
    }
  }
  EXPECT_GT(sum / poses, 0.6);
  EXPECT_LT(sum / poses, 1.5);
}

}  // namespace
}  // namespace slam6d::test
