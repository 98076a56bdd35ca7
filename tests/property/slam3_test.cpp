// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "slam6d/graph/ceres_loop_closer.hpp"
#include "slam6d/mapping/slam.hpp"
#include "tests/support/drive3.hpp"

namespace slam6d {
namespace {

const graph::CeresLoopCloser kCloser;

std::vector<SlamStep> AddAll(Slam& slam, const Drive3& drive) {
  std::vector<SlamStep> steps;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    steps.push_back(slam.Add(drive.scans[i], drive.T_odom_scan[i]));
  }
  return steps;
}

TEST(Slam3, RegistersADriveThatOdometryLoses) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Drive3 drive = DriveInCircle(14, 4000, seed);
    ASSERT_GT(LargestErrorM(drive.T_odom_scan, drive.T_room_scan), 0.1);
    Slam slam({.refinement = {.enabled = true}}, kCloser);
    const std::vector<SlamStep> steps = AddAll(slam, drive);
    EXPECT_EQ(steps.front().status, SlamStatus::kFirst);
    for (std::size_t i = 1; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i].status, SlamStatus::kMatched) << "scan " << i;
    }
    EXPECT_FALSE(steps.back().loops_to.empty());
    EXPECT_LT(LargestErrorM(slam.T_map_scan(), drive.T_room_scan), 0.005);
    const RefinementResult refined = slam.Refine();
    EXPECT_GT(refined.fits, 0U);
    EXPECT_LT(LargestErrorM(slam.T_map_scan(), drive.T_room_scan), 0.005);
  }
}

TEST(Slam3, GivesTheSameBitsForAnyNumberOfThreads) {
  const Drive3 drive = DriveInCircle(5, 2000, 5);
  for (const auto& [name, metric] : Names(IcpMetric{})) {
    SCOPED_TRACE(name);
    std::vector<Pose3> expected;
    for (const int threads : {1, 2, 5}) {
      SlamOptions options;
      options.icp.metric = metric;
      options.icp.max_iterations = 15;
      options.icp.threads = threads;
      options.refinement.enabled = true;
      Slam slam(options, kCloser);
      static_cast<void>(AddAll(slam, drive));
      static_cast<void>(slam.Refine());
      if (threads == 1) expected = slam.T_map_scan();
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(slam.T_map_scan()[i].rotation, expected[i].rotation);
        EXPECT_EQ(slam.T_map_scan()[i].translation_m, expected[i].translation_m);
      }
    }
  }
}

TEST(Slam3, LosesNothingToScansThatAreNone) {
  Drive3 drive = DriveInCircle(8, 4000, 7);
  PointCloud one_place;
  for (int i = 0; i < 5000; ++i) one_place.push_back({1.0, 2.0, 0.5});
  PointCloud not_numbers;
  not_numbers.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  drive.scans[0] = PointCloud{};
  drive.scans[3] = one_place;
  drive.scans[5] = not_numbers;
  drive.scans[6] = PointCloud(2);
  Slam slam({}, kCloser);
  const std::vector<SlamStep> steps = AddAll(slam, drive);
  for (const std::size_t i : {0U, 3U, 5U, 6U}) EXPECT_EQ(steps[i].status, SlamStatus::kUnusable);
  EXPECT_EQ(steps[1].status, SlamStatus::kFirst);
  for (const std::size_t i : {2U, 4U, 7U}) EXPECT_EQ(steps[i].status, SlamStatus::kMatched);
  static_cast<void>(slam.Refine());
  EXPECT_EQ(slam.T_map_scan().size(), drive.scans.size());
  const Pose3 estimate = slam.T_map_scan()[1].Inverse() * slam.T_map_scan()[7];
  const Pose3 truth = drive.T_room_scan[1].Inverse() * drive.T_room_scan[7];
  EXPECT_LT((estimate.translation_m - truth.translation_m).norm(), 0.005);
}

TEST(Slam3, DeadReckonsWhereAScanShowsAnotherPlace) {
  Drive3 drive = DriveInCircle(4, 4000, 8);
  drive.scans[2] = Pose3{.translation_m = {200.0, 0.0, 0.0}} * drive.scans[2];
  Slam slam({}, kCloser);
  const std::vector<SlamStep> steps = AddAll(slam, drive);
  EXPECT_EQ(steps[2].status, SlamStatus::kDeadReckoned);
  EXPECT_EQ(steps[3].status, SlamStatus::kMatched);
}

TEST(Slam3, DoesNotBelieveWhatNothingSpeaksFor) {
  const Pose3 away{.translation_m = {100.0, 0.0, 0.0}};
  const Drive3 drive = DriveInCircle(2, 4000, 8);
  Slam slam({}, kCloser);
  static_cast<void>(slam.Add(away * drive.scans[0], {}));
  const SlamStep step = slam.Add(away * drive.scans[0], {});
  EXPECT_EQ(step.match.status, IcpStatus::kConverged);
  EXPECT_EQ(step.told, 0U);
  EXPECT_EQ(step.status, SlamStatus::kDeadReckoned);
}

TEST(Slam3, ThinsToCubesLargerThanSurfacesAreThick) {
  constexpr double kNoise_m = 0.03;
  constexpr int kPoints = 60'000;
  const Pose3 T_first_second{.rotation = RotationFromRollPitchYaw({0.0, 0.0, 0.05}),
                             .translation_m = {0.3, 0.1, 0.0}};
  const Pose3 stand{.translation_m = {-1.0, -1.0, 1.2}};
  Slam slam({}, kCloser);
  static_cast<void>(slam.Add(ScanRoom(stand, kPoints, kNoise_m, 1), {}));
  const SlamStep step = slam.Add(ScanRoom(stand * T_first_second, kPoints, kNoise_m, 2), {});
  EXPECT_GT(step.voxel_m, 2.0 * kNoise_m);
  EXPECT_EQ(step.status, SlamStatus::kMatched);
  EXPECT_EQ(step.open_motions, 0);
  EXPECT_LT((step.T_map_scan.translation_m - T_first_second.translation_m).norm(), 0.01);
}

// Points that lie on nothing fit nowhere: with all of them, twenty times as much was sought as for a
// scan that fits.
TEST(Slam3, SeeksWhatFitsNowhereWithFewPoints) {
  constexpr std::size_t kPoints = 40'000;
  std::mt19937 random(11);
  PointCloud nothing;
  while (nothing.size() < kPoints) nothing.push_back(DrawNormal(random, 1.0));
  const PointCloud room = DriveInCircle(2, kPoints, 11).scans.front();
  const ScanModel models[]{ScanModel(room), ScanModel(nothing)};
  const RangeImage images[]{RangeImage(room), RangeImage(nothing)};
  const PlacedScan ref{.model = &models[0], .image = &images[0], .T_map_scan = {}};
  const PlacedScan cur{.model = &models[1], .image = &images[1], .T_map_scan = {}};
  const Registration registration = RegisterScan(std::span(&ref, 1), cur, GuessCovariance({}), {});
  EXPECT_FALSE(registration.convinces);
  EXPECT_LT(registration.icp.search.queries, 10 * kPoints);
}

TEST(Slam3, RefinementGathersScansThatWereLeftApart) {
  const Drive3 drive = DriveInCircle(6, 4000, 9);
  std::mt19937 random(9);
  std::vector<ScanModel> models;
  for (const PointCloud& scan : drive.scans) models.emplace_back(scan);
  std::vector<IcpReference> scans;
  for (std::size_t i = 0; i < models.size(); ++i) {
    Pose3 T_room_scan = drive.T_room_scan[i];
    if (i > 0) T_room_scan.translation_m += DrawNormal(random, 0.03);
    scans.push_back({.model = &models[i], .T_map_ref = T_room_scan});
  }
  const RefinementOptions options{.max_visits = 30};
  const RefinementResult result = RefineModel(scans, {}, options);
  EXPECT_TRUE(result.settled);
  EXPECT_EQ(result.T_map_scan[0].translation_m, scans[0].T_map_ref.translation_m);
  EXPECT_LT(LargestErrorM(result.T_map_scan, drive.T_room_scan), 0.003);
  const auto stop_at_once = [](const RefinementProgress&) { return false; };
  EXPECT_EQ(RefineModel(scans, {}, options, stop_at_once).fits, 1U);
}

TEST(Slam3, FitsNothingWhereThatIsNotWanted) {
  const Drive3 drive = DriveInCircle(4, 3000, 10);
  Slam slam({}, kCloser);
  static_cast<void>(AddAll(slam, drive));
  const Pose3 before = slam.T_map_scan().back();
  const RefinementResult result = slam.Refine();
  EXPECT_EQ(result.fits, 0U);
  EXPECT_EQ(result.T_map_scan.back().translation_m, before.translation_m);
}

TEST(Slam3, ExtrapolatesOdometryInThePlaneWhereTheRobotStands) {
  // On a slope of 0.2 rad, one metre ahead by odometry is also a way down.
  const Pose3 T_map_last{.rotation = RotationFromRollPitchYaw({0.0, 0.2, 0.0}),
                         .translation_m = {3.0, 1.0, 2.0}};
  const Pose3 T_odom_scan{.translation_m = {1.0, 0.0, 0.0}};
  const Pose3 pose = ExtrapolateOdometry(T_map_last, {}, T_odom_scan);
  EXPECT_NEAR(pose.translation_m.x(), 3.0 + std::cos(0.2), 1e-12);
  EXPECT_NEAR(pose.translation_m.z(), 2.0 - std::sin(0.2), 1e-12);
  EXPECT_TRUE(pose.rotation.isApprox(T_map_last.rotation));
}

}  // namespace
}  // namespace slam6d
