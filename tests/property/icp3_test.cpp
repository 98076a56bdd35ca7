// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "slam6d/icp/icp.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

constexpr IcpMetric kMetrics[] = {
    IcpMetric::kPointToPoint, IcpMetric::kPointToPlane, IcpMetric::kPlaneToPlane};

struct RoomPair {
  Pose3 T_room_ref;
  Pose3 T_ref_cur;
  ScanModel ref;
  ScanModel cur;
};

Pose3 SmallPose(double roll, double pitch, double yaw, const Eigen::Vector3d& translation_m) {
  return {.rotation = RotationFromRollPitchYaw({roll, pitch, yaw}), .translation_m = translation_m};
}

RoomPair MakePair(int points, unsigned seed) {
  std::mt19937 random(seed);
  const Pose3 T_room_ref = SmallPose(0.02, -0.01, 0.3, {0.5, -0.3, 1.0});
  const Pose3 T_ref_cur{.rotation = RotationFromVector(DrawNormal(random, 0.02)),
                        .translation_m = DrawNormal(random, 0.08)};
  return {.T_room_ref = T_room_ref,
          .T_ref_cur = T_ref_cur,
          .ref = ScanModel(ScanRoom(T_room_ref, points, 0.005, 2 * seed)),
          .cur = ScanModel(ScanRoom(T_room_ref * T_ref_cur, points, 0.005, 2 * seed + 1))};
}

double DistanceM(const Pose3& a, const Pose3& b) {
  return (a.translation_m - b.translation_m).norm();
}
double AngleRad(const Pose3& a, const Pose3& b) {
  return RotationAngle(a.rotation.transpose() * b.rotation);
}

TEST(Icp3, FindsTheMotionBetweenTwoScansOfARoom) {
  for (const IcpMetric metric : kMetrics) {
    // Points pair with other samples of the surface, surfels with the surface itself.
    const double bound_m = metric == IcpMetric::kPointToPoint ? 0.02 : 0.002;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "metric " << static_cast<int>(metric) << " seed " << seed);
      const RoomPair room = MakePair(8000, seed);
      const IcpResult result = Align(room.ref, room.cur, Pose3{}, {.metric = metric});
      EXPECT_EQ(result.status, IcpStatus::kConverged);
      EXPECT_LT(DistanceM(result.T_ref_cur, room.T_ref_cur), bound_m);
      EXPECT_LT(AngleRad(result.T_ref_cur, room.T_ref_cur), 0.5 * bound_m);
    }
  }
}

TEST(Icp3, SwappedScansGiveTheInverse) {
  const RoomPair room = MakePair(8000, 11);
  for (const IcpMetric metric : kMetrics) {
    const IcpOptions options{.metric = metric};
    const Pose3 there = Align(room.ref, room.cur, Pose3{}, options).T_ref_cur;
    const Pose3 back = Align(room.cur, room.ref, Pose3{}, options).T_ref_cur;
    const double bound_m = metric == IcpMetric::kPointToPoint ? 0.02 : 0.003;
    EXPECT_LT(DistanceM(there, back.Inverse()), bound_m);
    EXPECT_LT(AngleRad(there, back.Inverse()), bound_m);
  }
}

TEST(Icp3, MovingTheCurrentScanMovesTheResult) {
  std::mt19937 random(3);
  const RoomPair room = MakePair(3000, 12);
  const Pose3 T_cur_moved = SmallPose(0.4, -0.2, 1.0, {3.0, -2.0, 1.0});
  const IcpOptions options{.metric = IcpMetric::kPointToPoint};
  const IcpResult plain = Align(room.ref, room.cur, Pose3{}, options);
  const ScanModel moved(T_cur_moved.Inverse() * room.cur.points);
  const IcpResult shifted = Align(room.ref, moved, T_cur_moved, options);
  EXPECT_LT(DistanceM(shifted.T_ref_cur, plain.T_ref_cur * T_cur_moved), 1e-8);
  EXPECT_EQ(shifted.iterations, plain.iterations);
}

TEST(Icp3, ClosedFormsCacheAndRootSearchLeadToTheSamePose) {
  const RoomPair room = MakePair(4000, 13);
  const IcpResult expected =
      Align(room.ref, room.cur, Pose3{}, {.metric = IcpMetric::kPointToPoint});
  for (const auto& [name, form] : Names(ClosedForm{})) {
    for (const SearchStart start : {SearchStart::kCache, SearchStart::kRoot}) {
      SCOPED_TRACE(name);
      const IcpOptions options{
          .metric = IcpMetric::kPointToPoint, .closed_form = form, .search = start};
      const IcpResult result = Align(room.ref, room.cur, Pose3{}, options);
      EXPECT_LT(DistanceM(result.T_ref_cur, expected.T_ref_cur), 1e-9);
      EXPECT_EQ(result.iterations, expected.iterations);
      EXPECT_EQ(result.search.proven_unchanged > 0, start == SearchStart::kCache);
    }
  }
}

TEST(Icp3, GivesTheSameBitsForAnyNumberOfThreads) {
  const RoomPair room = MakePair(20000, 14);
  for (const IcpMetric metric : kMetrics) {
    const IcpResult expected = Align(room.ref, room.cur, Pose3{}, {.metric = metric});
    for (const int threads : {2, 3, 8}) {
      const IcpResult result =
          Align(room.ref, room.cur, Pose3{}, {.metric = metric, .threads = threads});
      EXPECT_EQ(result.T_ref_cur.rotation, expected.T_ref_cur.rotation);
      EXPECT_EQ(result.T_ref_cur.translation_m, expected.T_ref_cur.translation_m);
      EXPECT_EQ(result.covariance, expected.covariance);
      EXPECT_EQ(result.search.leaves_visited, expected.search.leaves_visited);
    }
  }
}

TEST(Icp3, KeepsItsAccuracyFarFromTheOrigin) {
  const RoomPair room = MakePair(4000, 15);
  const Pose3 T_far_ref{.translation_m = {4.5e5, 5.4e6, 100.0}};
  const ScanModel far(T_far_ref * room.ref.points);
  const IcpOptions options{.metric = IcpMetric::kPointToPoint};
  const IcpResult near_result = Align(room.ref, room.cur, Pose3{}, options);
  const IcpResult far_result = Align(far, room.cur, T_far_ref, options);
  EXPECT_LT(DistanceM(far_result.T_ref_cur, T_far_ref * near_result.T_ref_cur), 1e-6);
}

TEST(Icp3, DropsOutliersByTheRootMeanSquare) {
  const RoomPair room = MakePair(8000, 16);
  PointCloud with_box = room.cur.points;
  std::mt19937 random(5);
  for (int i = 0; i < 400; ++i) {  // Somebody stands before the wall.
    const Eigen::Vector3d p_room = Eigen::Vector3d(-3.3, 0.3, 1.0) + DrawNormal(random, 0.1);
    with_box.push_back((room.T_room_ref * room.T_ref_cur).Inverse() * p_room);
  }
  const ScanModel cur(with_box);
  const IcpOptions plain{.metric = IcpMetric::kPointToPoint, .max_distance_m = 1.0};
  IcpOptions robust = plain;
  robust.max_rms_ratio = 2.5;
  const double plain_m = DistanceM(Align(room.ref, cur, Pose3{}, plain).T_ref_cur, room.T_ref_cur);
  const double robust_m =
      DistanceM(Align(room.ref, cur, Pose3{}, robust).T_ref_cur, room.T_ref_cur);
  EXPECT_LT(robust_m, 0.5 * plain_m);
}

TEST(Icp3, SaysWhyItFailed) {
  const RoomPair room = MakePair(500, 17);
  const ScanModel empty(PointCloud{});
  const Pose3 far_away{.translation_m = {100.0, 0.0, 0.0}};
  PointCloud floor;
  for (int i = 0; i < 2000; ++i) floor.push_back({0.1 * (i % 50), 0.1 * (i / 50), 0.0});
  const ScanModel plane(floor);
  for (const IcpMetric metric : kMetrics) {
    const IcpOptions options{.metric = metric};
    EXPECT_EQ(Align(room.ref, empty, Pose3{}, options).status, IcpStatus::kTooFewPairs);
    EXPECT_EQ(Align(empty, room.cur, Pose3{}, options).status, IcpStatus::kTooFewPairs);
    const IcpResult lost = Align(room.ref, room.cur, far_away, options);
    EXPECT_EQ(lost.status, IcpStatus::kTooFewPairs);
    EXPECT_EQ(lost.T_ref_cur.translation_m, far_away.translation_m);
  }
  EXPECT_EQ(Align(plane, plane, Pose3{}, {.metric = IcpMetric::kPlaneToPlane}).status,
            IcpStatus::kDegenerate);
  EXPECT_EQ(
      Align(room.ref, room.cur, Pose3{}, {.metric = IcpMetric::kPointToPoint, .max_iterations = 1})
          .status,
      IcpStatus::kIterationLimit);
}

/// Floor and walls of a corridor along x, and of its ends only what is asked for, as a scanner at
/// (x_m, 0, 1) sees them: what it sees moves with it.
PointCloud ScanCorridor(double x_m, double end_x_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  PointCloud cloud;
  for (int i = 0; i < 6000; ++i) {
    const double along_m = 8.0 * share(random) - 4.0;
    const double across_m = 2.0 * share(random);
    const Eigen::Vector3d surfaces_m[] = {{along_m, across_m - 1.0, -1.0},
                                          {along_m, -1.0, across_m - 1.0},
                                          {along_m, 1.0, across_m - 1.0}};
    Eigen::Vector3d point_m = surfaces_m[i % 3];
    if (i % 12 == 0) point_m = {end_x_m - x_m, across_m - 1.0, 2.0 * share(random) - 1.0};
    cloud.push_back(point_m + DrawNormal(random, 0.01));
  }
  return cloud;
}

TEST(Icp3, LeavesTheWayAlongACorridorToTheGuess) {
  // Each scanner sees an end that the other does not.
  const ScanModel ref(ScanCorridor(0.0, -6.0, 21));
  const ScanModel cur(ScanCorridor(0.5, 7.0, 22));
  const Pose3 T_ref_cur_guess = SmallPose(0.01, 0.0, -0.01, {0.52, 0.03, 0.02});
  for (const IcpMetric metric : {IcpMetric::kPointToPlane, IcpMetric::kPlaneToPlane}) {
    const IcpResult result = Align(ref, cur, T_ref_cur_guess, {.metric = metric});
    EXPECT_EQ(result.status, IcpStatus::kConverged);
    EXPECT_NEAR(result.T_ref_cur.translation_m.x(), 0.52, 0.01);
    EXPECT_NEAR(result.T_ref_cur.translation_m.y(), 0.0, 0.005);
    EXPECT_NEAR(result.T_ref_cur.translation_m.z(), 0.0, 0.005);
    EXPECT_GT(std::sqrt(result.covariance(0, 0)), 0.2);
    EXPECT_LT(std::sqrt(result.covariance(1, 1)), 0.005);
  }
}

TEST(Icp3, TellsTheTwoSidesOfAThinWallApart) {
  // The wall is 10 cm thick; one scanner stands before it, the other behind.
  const ScanModel ref(ScanCorridor(-2.0, -0.05, 23));
  const ScanModel cur(ScanCorridor(2.0, 0.05, 24));
  const Pose3 T_ref_cur = SmallPose(0.0, 0.0, 0.0, {4.0, 0.0, 0.0});
  for (const IcpMetric metric : {IcpMetric::kPointToPlane, IcpMetric::kPlaneToPlane}) {
    const IcpResult result = Align(ref, cur, T_ref_cur, {.metric = metric});
    EXPECT_LT(DistanceM(result.T_ref_cur, T_ref_cur), 0.02);
  }
}

TEST(Icp3, CovarianceOfPlanesPredictsTheErrors) {
  // Normalised estimation error squared over many rooms: 6 for a perfect covariance.
  double nees = 0.0;
  constexpr int kRooms = 30;
  for (unsigned seed = 100; seed < 100 + kRooms; ++seed) {
    const RoomPair room = MakePair(6000, seed);
    const IcpResult result = Align(room.ref, room.cur, Pose3{}, {});
    ASSERT_EQ(result.status, IcpStatus::kConverged);
    const Vector6d error = Difference(result.T_ref_cur, room.T_ref_cur);
    nees += error.dot(result.covariance.inverse() * error) / kRooms;
  }
  EXPECT_GT(nees, 1.0);
  EXPECT_LT(nees, 12.0);
}

}  // namespace
}  // namespace slam6d
