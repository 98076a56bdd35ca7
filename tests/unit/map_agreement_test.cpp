// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two maps that are drawn of one place go together: in buildings that repeat themselves,
// too, which show as much of that as has been mapped.
#include "service/team/atlas/map_agreement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stop_token>
#include <vector>

#include "service/team/atlas/joint_candidates.hpp"
#include "service/team/atlas/map_echoes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::team {
namespace {

constexpr double kSureNats = 3.0;
constexpr double kLeg_m = 6.0;
constexpr double kBend_rad = 0.6;
const double kPeriod_m = 2.0 * kLeg_m * std::cos(kBend_rad);

/// A robot that looks all around, up to 8 m.
test::DriveOptions LooksAround() {
  test::DriveOptions options;
  options.laser.field_of_view_rad = 6.2;
  options.laser.range_max_m = 8.0;
  options.scan_period_s = 1.0;
  return options;
}

Eigen::Vector2d Corner(int corner, double y_m) {
  return {0.5 * corner * kPeriod_m, y_m + (corner % 2 == 0 ? 0.0 : kLeg_m * std::sin(kBend_rad))};
}

/// A corridor of legs that bend to the right and to the left by turns, and go on for ever.
/// @param last the way leads from one corner to another one.
test::Scene Zigzag(int first, int last) {
  test::Scene scene;
  for (int corner = -4; corner < 12; ++corner) {
    for (const double side_m : {-1.2, 1.2}) {
      scene.world.walls.push_back({Corner(corner, side_m), Corner(corner + 1, side_m)});
    }
  }
  for (int corner = first; corner <= last; ++corner) scene.route_m.push_back(Corner(corner, 0.0));
  return scene;
}

/// A map without errors.
ScanMap MapOf(const test::Scene& scene, const test::DriveOptions& options = LooksAround()) {
  const test::SimulatedDrive drive = test::DriveThrough(scene, options);
  ScanMap map;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    const LaserScan& scan = drive.observations[i].scan;
    map.Insert(
        scan, ToPoints(scan), UncertainPose2::WithSigmas(drive.T_world_robot[i], 0.005, 0.002));
  }
  return map;
}

/// Another drive along the same way.
ScanMap AgainMapOf(const test::Scene& scene) {
  test::DriveOptions options = LooksAround();
  options.seed = 2;
  return MapOf(scene, options);
}

UncertainPose2 At(double x_m, double y_m) {
  return UncertainPose2::WithSigmas({x_m, y_m, 0.0}, 0.1, 0.02);
}

MapAgreement Agreement() { return {ScanLocatorOptions{}, FreeSpaceOptions{}}; }

std::optional<Joint> DecideOn(const UncertainPose2& a_b,
                              const ScanMap& a,
                              const ScanMap& b,
                              const std::stop_token& stop = {}) {
  JointCandidates candidates;
  candidates.Propose(a_b, b.scans().front().map_robot.T_a_b);
  return candidates.Decide(
      Agreement(), {.map = a, .scans_of_robots = {}}, {.map = b, .scans_of_robots = {}}, {}, stop);
}

std::vector<const RelevantScan*> AllOf(const ScanMap& map) {
  std::vector<const RelevantScan*> all;
  for (const RelevantScan& scan : map.scans()) all.push_back(&scan);
  return all;
}

TEST(MapEchoes, AreAPeriodOfACorridorAway) {
  const ScanMap map = MapOf(Zigzag(0, 4));
  const std::vector<Pose2> echoes = FindEchoes(AllOf(map), map);
  EXPECT_TRUE(std::ranges::any_of(echoes, [](const Pose2& T_map_map) {
    return std::abs(std::abs(T_map_map.x_m) - kPeriod_m) < 0.1 && std::abs(T_map_map.y_m) < 0.1 &&
           std::abs(T_map_map.theta_rad) < 0.01;
  }));
  // So is what the corridor looks like to whoever comes from the other end.
  for (const Pose2& T_map_map : echoes) EXPECT_GT(T_map_map.translation_m().norm(), 1.0);
}

TEST(MapEchoes, AreWhereAnotherMapLooksAlike) {
  const ScanMap map = MapOf(test::FurnishedRoom());
  const std::vector<Pose2> likenesses =
      FindLikenesses(AllOf(map), AgainMapOf(test::FurnishedRoom()));
  ASSERT_FALSE(likenesses.empty());
  EXPECT_LT(likenesses.front().translation_m().norm(), 0.2);
  EXPECT_LT(std::abs(likenesses.front().theta_rad), 0.05);
}

TEST(MapEchoes, AreNoneOfNothing) {
  EXPECT_TRUE(FindEchoes({}, ScanMap()).empty());
  EXPECT_TRUE(FindLikenesses({}, ScanMap()).empty());
  const ScanMap map = MapOf(Zigzag(0, 1));
  EXPECT_TRUE(FindEchoes(std::vector{&map.scans().front()}, ScanMap()).empty());
  EXPECT_TRUE(FindLikenesses(std::vector{&map.scans().front()}, ScanMap()).empty());
}

TEST(MapAgreement, BelievesNoMoreOfAPlaceThanTheMapRepeats) {
  const ScanMap a = MapOf(Zigzag(0, 4));
  const ScanMap b = AgainMapOf(Zigzag(4, 6));
  const UncertainPose2 a_period_off = At(-kPeriod_m, 0.0);
  EXPECT_GT(Agreement().Judge(a, b, a_period_off).nats, kSureNats);
  EXPECT_LT(Agreement().NatsAmongEchoes(a, b, a_period_off), kSureNats);
  EXPECT_FALSE(DecideOn(a_period_off, a, b));
}

TEST(MapAgreement, BelievesAPlaceThatIsThereOnce) {
  const ScanMap a = MapOf(test::FurnishedRoom());
  const ScanMap b = AgainMapOf(test::FurnishedRoom());
  const double nats = Agreement().Judge(a, b, At(0.0, 0.0)).nats;
  EXPECT_GT(nats, kSureNats);
  EXPECT_NEAR(Agreement().NatsAmongEchoes(a, b, At(0.0, 0.0)), nats, 0.5);
  const std::optional<Joint> found = DecideOn(At(0.1, -0.1), a, b);
  ASSERT_TRUE(found);
  EXPECT_LT(found->a_b.T_a_b.translation_m().norm(), 0.02);
  EXPECT_NEAR(found->nats, nats, 0.5);
}

TEST(MapAgreement, TellsNothingOnceItIsStopped) {
  const ScanMap a = MapOf(test::FurnishedRoom());
  const ScanMap b = AgainMapOf(test::FurnishedRoom());
  std::stop_source stopped;
  stopped.request_stop();
  // Where no scan is looked at, nothing speaks for a place.
  EXPECT_LT(Agreement().Judge(a, b, At(0.0, 0.0), stopped.get_token()).nats, 1e-9);
  EXPECT_LT(Agreement().NatsAmongEchoes(a, b, At(0.0, 0.0), stopped.get_token()), 1e-9);
  EXPECT_TRUE(FindEchoes(AllOf(a), a, stopped.get_token()).empty());
  EXPECT_FALSE(DecideOn(At(0.0, 0.0), a, b, stopped.get_token()));
}

TEST(MapAgreement, KnowsThatItDoesNotKnowWhereAlongAWall) {
  test::Scene straight;
  for (const double side_m : {-1.2, 1.2}) {
    straight.world.walls.push_back({{-50.0, side_m}, {50.0, side_m}});
  }
  straight.route_m = {{0.0, 0.0}, {12.0, 0.0}};
  const ScanMap a = MapOf(straight);
  const ScanMap b = AgainMapOf(straight);
  const MapAgreement::Judgement judged = Agreement().Judge(a, b, At(2.0, 0.0));
  EXPECT_GT(judged.nats, kSureNats);
  EXPECT_NEAR(std::abs(judged.least_known.x()), 1.0, 0.01);
  EXPECT_FALSE(DecideOn(At(2.0, 0.0), a, b));
}

}  // namespace
}  // namespace qwsm::team
