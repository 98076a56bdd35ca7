// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "qwsm/metrics/error_statistics.hpp"
#include "qwsm/metrics/nees.hpp"
#include "qwsm/metrics/odometry_carrier.hpp"
#include "qwsm/metrics/pose_lookup.hpp"
#include "qwsm/metrics/relations.hpp"
#include "qwsm/metrics/trajectory_error.hpp"

namespace qwsm {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

using std::numbers::pi;

TEST(ErrorStatistics, AgreeWithHandComputedValues) {
  const ErrorStatistics errors = Summarize({4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(errors.count, 4U);
  EXPECT_DOUBLE_EQ(errors.mean, 2.5);
  EXPECT_DOUBLE_EQ(errors.standard_deviation, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(errors.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(errors.median, 2.5);
  EXPECT_DOUBLE_EQ(errors.upper_median, 3.0);
  EXPECT_DOUBLE_EQ(errors.percentile_95, 4.0);
  EXPECT_DOUBLE_EQ(errors.min, 1.0);
  EXPECT_DOUBLE_EQ(errors.max, 4.0);
  EXPECT_DOUBLE_EQ(errors.sum_of_squares, 30.0);
}

TEST(ErrorStatistics, OfNothingAreNotNumbers) {
  const ErrorStatistics errors = Summarize({});
  EXPECT_EQ(errors.count, 0U);
  EXPECT_TRUE(std::isnan(errors.mean));
  EXPECT_TRUE(std::isnan(errors.max));
  EXPECT_EQ(errors.sum_of_squares, 0.0);
}

TEST(ErrorStatistics, OfSquares) {
  const ErrorStatistics squares = SummarizeSquares({1.0, 3.0});
  EXPECT_DOUBLE_EQ(squares.mean, 5.0);
  EXPECT_DOUBLE_EQ(squares.standard_deviation, 4.0);
}

// One metre east per second, turning left by 0.1 rad per second.
Trajectory EastwardDrive() {
  return {
      {seconds(0), {0.0, 0.0, 0.0}}, {seconds(1), {1.0, 0.0, 0.1}}, {seconds(2), {2.0, 0.0, 0.2}}};
}

TEST(NearestIndex, TakesTheEarlierOfTwoAtEqualDistance) {
  const Trajectory drive = EastwardDrive();
  EXPECT_EQ(NearestIndex(drive, milliseconds(1500), seconds(1)), 1U);
  EXPECT_EQ(NearestIndex(drive, milliseconds(1501), seconds(1)), 2U);
  EXPECT_EQ(NearestIndex(drive, seconds(3), seconds(1)), 2U);
  EXPECT_EQ(NearestIndex(drive, seconds(-1), seconds(1)), 0U);
}

TEST(NearestIndex, FindsNothingBeyondTheTolerance) {
  EXPECT_EQ(NearestIndex(EastwardDrive(), milliseconds(1400), milliseconds(399)), std::nullopt);
  EXPECT_EQ(NearestIndex(EastwardDrive(), milliseconds(1400), milliseconds(400)), 1U);
  EXPECT_EQ(NearestIndex({}, seconds(0), seconds(1)), std::nullopt);
}

TEST(InterpolatedPose, LiesBetweenItsNeighbours) {
  const Trajectory turn = {{seconds(0), {0.0, 1.0, 3.0}}, {seconds(4), {4.0, 1.0, -3.0}}};
  const std::optional<Pose2> pose = InterpolatedPose(turn, seconds(1), microseconds(0));
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x_m, 1.0);
  EXPECT_DOUBLE_EQ(pose->y_m, 1.0);
  // The short way round: from 3 over pi to 2 pi - 3, a quarter of it.
  EXPECT_NEAR(pose->theta_rad, 3.0 + 0.25 * (2.0 * pi - 6.0), 1e-12);
}

TEST(InterpolatedPose, EndsWithTheTolerance) {
  EXPECT_EQ(InterpolatedPose(EastwardDrive(), milliseconds(2300), milliseconds(300)),
            Pose2(2.0, 0.0, 0.2));
  EXPECT_EQ(InterpolatedPose(EastwardDrive(), milliseconds(2301), milliseconds(300)), std::nullopt);
  EXPECT_EQ(InterpolatedPose(EastwardDrive(), milliseconds(-1), milliseconds(0)), std::nullopt);
}

TEST(Relations, CompareRelativePosesWhateverTheFrame) {
  const Pose2 T_map_other{30.0, -4.0, 2.0};
  Trajectory drive = EastwardDrive();
  for (StampedPose2& pose : drive) pose.T_map_robot = T_map_other * pose.T_map_robot;
  const std::vector<Relation> relations = {
      {.first = seconds(0), .second = seconds(1), .T_first_second = {1.0, 0.0, 0.1}}};
  const RelationsResult result = EvaluateRelations(relations, drive);
  EXPECT_EQ(result.all.translation_m.count, 1U);
  EXPECT_NEAR(result.all.translation_m.mean, 0.0, 1e-12);
  EXPECT_NEAR(result.all.rotation_rad.mean, 0.0, 1e-12);
}

TEST(Relations, SummariseErrorsInTheFirstPosesFrame) {
  const std::vector<Relation> relations = {
      {.first = seconds(0), .second = seconds(1), .T_first_second = {0.7, 0.4, 0.0}},  // 0.5 m, 0.1
      {.first = seconds(0),
       .second = seconds(2),
       .T_first_second = {2.0, -1.0, 0.5}},  // 1.0 m, 0.3
      {.first = seconds(0), .second = seconds(20), .T_first_second = {20.0, 0.0, 2.0}},  // Unknown.
  };
  const RelationsResult result =
      EvaluateRelations(relations, EastwardDrive(), {.local_duration = milliseconds(1500)});
  EXPECT_EQ(result.skipped, 1U);
  EXPECT_DOUBLE_EQ(result.all.translation_m.mean, 0.75);
  EXPECT_DOUBLE_EQ(result.all.translation_m.standard_deviation, 0.25);
  EXPECT_DOUBLE_EQ(result.all.translation_squared_m2.mean, 0.625);
  EXPECT_NEAR(result.all.rotation_rad.mean, 0.2, 1e-12);
  EXPECT_NEAR(result.all.rotation_rad.standard_deviation, 0.1, 1e-12);
  EXPECT_DOUBLE_EQ(result.local.translation_m.mean, 0.5);
  EXPECT_DOUBLE_EQ(result.global.translation_m.mean, 1.0);
  ASSERT_EQ(result.errors.size(), 2U);
  EXPECT_EQ(result.errors[1].relation, 1U);
}

TEST(Relations, TakePosesAsTheLookupSays) {
  const std::vector<Relation> relations = {
      {.first = seconds(0), .second = milliseconds(1500), .T_first_second = {1.5, 0.0, 0.15}}};
  RelationsOptions options{.lookup = PoseLookup::kNearest};
  EXPECT_EQ(EvaluateRelations(relations, EastwardDrive(), options).skipped, 1U);
  options.lookup = PoseLookup::kInterpolated;
  EXPECT_NEAR(
      EvaluateRelations(relations, EastwardDrive(), options).all.translation_m.mean, 0.0, 1e-12);
}

TEST(Relations, FindPosesWhoseStampsStepBack) {
  Trajectory drive = EastwardDrive();
  std::swap(drive[0], drive[2]);
  const std::vector<Relation> relations = {
      {.first = seconds(0), .second = seconds(2), .T_first_second = {2.0, 0.0, 0.2}}};
  const RelationsResult result = EvaluateRelations(relations, drive);
  EXPECT_EQ(result.skipped, 0U);
  EXPECT_NEAR(result.all.translation_m.mean, 0.0, 1e-12);
}

TEST(Associate, GivesEachPoseOfTheShorterItsNearestOfTheLonger) {
  const Trajectory estimate = {{milliseconds(90), {0.1, 0.0, 0.0}},
                               {milliseconds(1900), {1.9, 0.0, 0.0}}};
  const std::vector<PosePair> pairs = Associate(EastwardDrive(), estimate, milliseconds(90));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].stamp, seconds(0));
  EXPECT_DOUBLE_EQ(pairs[0].T_map_robot.x_m, 0.1);
  EXPECT_EQ(Associate(EastwardDrive(), estimate, milliseconds(100)).size(), 2U);
  EXPECT_EQ(Associate(estimate, EastwardDrive(), milliseconds(100)).size(), 2U);
}

std::vector<PosePair> PairsOf(const std::vector<std::pair<Pose2, Pose2>>& ref_and_map) {
  std::vector<PosePair> pairs;
  for (const auto& [T_ref_robot, T_map_robot] : ref_and_map) {
    pairs.push_back({.T_ref_robot = T_ref_robot, .T_map_robot = T_map_robot});
  }
  return pairs;
}

TEST(AbsoluteTrajectoryError, IsTheDistanceOfThePositions) {
  const std::vector<PosePair> pairs =
      PairsOf({{{0.0, 0.0, 0.0}, {3.0, 4.0, 1.0}}, {{1.0, 1.0, 0.0}, {1.0, 2.0, 0.0}}});
  const ErrorStatistics error = AbsoluteTrajectoryError(pairs, Pose2{});
  EXPECT_DOUBLE_EQ(error.mean, 3.0);
  EXPECT_DOUBLE_EQ(error.rmse, std::sqrt(13.0));
  EXPECT_DOUBLE_EQ(error.min, 1.0);
  EXPECT_DOUBLE_EQ(error.max, 5.0);
  EXPECT_DOUBLE_EQ(error.sum_of_squares, 26.0);
}

TEST(AlignUmeyama, UndoesARigidMotion) {
  const Pose2 T_ref_map{5.0, -3.0, 2.5};
  std::vector<std::pair<Pose2, Pose2>> poses;
  for (const Pose2& T_map_robot :
       {Pose2{0, 0, 0}, Pose2{2, 0, 1}, Pose2{2, 1, -1}, Pose2{7, 3, 2}}) {
    poses.emplace_back(T_ref_map * T_map_robot, T_map_robot);
  }
  const std::vector<PosePair> pairs = PairsOf(poses);
  const Pose2 found = AlignUmeyama(pairs);
  EXPECT_NEAR(found.x_m, 5.0, 1e-12);
  EXPECT_NEAR(found.y_m, -3.0, 1e-12);
  EXPECT_NEAR(found.theta_rad, 2.5, 1e-12);
  EXPECT_NEAR(AbsoluteTrajectoryError(pairs, found).max, 0.0, 1e-12);
}

TEST(AlignUmeyama, DoesNotScale) {
  // A square of side 2 against one of side 1 around the same centre: no turn, each corner keeps
  // half of the diagonals' difference.
  const std::vector<PosePair> pairs = PairsOf({{{-1, -1, 0}, {9.5, -0.5, 0}},
                                               {{1, -1, 0}, {10.5, -0.5, 0}},
                                               {{1, 1, 0}, {10.5, 0.5, 0}},
                                               {{-1, 1, 0}, {9.5, 0.5, 0}}});
  const Pose2 found = AlignUmeyama(pairs);
  EXPECT_NEAR(found.x_m, -10.0, 1e-12);
  EXPECT_NEAR(found.theta_rad, 0.0, 1e-12);
  EXPECT_NEAR(AbsoluteTrajectoryError(pairs, found).rmse, std::sqrt(0.5), 1e-12);
}

TEST(AlignUmeyama, NeedsNoTurnForOnePosition) {
  const Pose2 found = AlignUmeyama(PairsOf({{{1, 2, 0}, {4, 4, 3}}, {{1, 2, 0}, {4, 4, 1}}}));
  EXPECT_EQ(found, Pose2(-3.0, -2.0, 0.0));
  EXPECT_EQ(AlignUmeyama({}), Pose2());
}

TEST(RelativePoseError, CountsAJumpOnceAndATurnAsTurn) {
  const std::vector<PosePair> pairs = PairsOf({{{0, 0, 0}, {5, 5, pi / 2}},
                                               {{1, 0, 0}, {5, 6, pi / 2}},    // Right.
                                               {{2, 0, 0}, {5, 7.3, pi / 2}},  // 0.3 m too far.
                                               {{3, 0, 0}, {5, 8.3, pi}}});    // Turned too much.
  const RelativePoseError error = EvaluateRelativePoses(pairs);
  EXPECT_EQ(error.translation_m.count, 3U);
  EXPECT_NEAR(error.translation_m.max, 0.3, 1e-12);
  EXPECT_NEAR(error.translation_m.mean, 0.1, 1e-12);
  EXPECT_NEAR(error.rotation_rad.max, pi / 2, 1e-12);
  EXPECT_NEAR(error.rotation_rad.median, 0.0, 1e-12);
}

TEST(RelativePoseError, StepsOverSeveralPairs) {
  std::vector<std::pair<Pose2, Pose2>> poses;
  for (int i = 0; i < 6; ++i) poses.push_back({{1.0 * i, 0, 0}, {1.1 * i, 0, 0}});
  const RelativePoseError error = EvaluateRelativePoses(PairsOf(poses), 2);
  EXPECT_EQ(error.translation_m.count, 2U);  // 0 to 2 and 2 to 4.
  EXPECT_NEAR(error.translation_m.mean, 0.2, 1e-12);
}

TEST(Nees, WeighsTheErrorByTheCovariance) {
  const UncertainPose2 estimate{.T_a_b = {1.0, 2.0, -3.1},
                                .covariance = Eigen::Vector3d(0.25, 4.0, 0.01).asDiagonal()};
  const Pose2 truth{0.5, 0.0, 3.1};
  const double turn_rad = 2.0 * pi - 6.2;  // Across the cut at pi.
  const std::optional<double> nees = Nees(estimate, truth);
  ASSERT_TRUE(nees);
  EXPECT_NEAR(*nees, 1.0 + 1.0 + turn_rad * turn_rad / 0.01, 1e-9);
}

TEST(Nees, UsesTheCrossTerms) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  covariance(0, 1) = covariance(1, 0) = 0.5;
  // The inverse of [1 0.5; 0.5 1] is [4/3 -2/3; -2/3 4/3].
  EXPECT_NEAR(*Nees({.T_a_b = {1.0, 1.0, 0.0}, .covariance = covariance}, {}), 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(*Nees({.T_a_b = {1.0, -1.0, 0.0}, .covariance = covariance}, {}), 4.0, 1e-12);
}

TEST(Nees, HasNoValueForACovarianceThatIsNone) {
  EXPECT_EQ(Nees({.T_a_b = {}, .covariance = Eigen::Matrix3d::Zero()}, {}), std::nullopt);
  Eigen::Matrix3d indefinite = Eigen::Matrix3d::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 1.5;
  EXPECT_EQ(Nees({.T_a_b = {}, .covariance = indefinite}, {}), std::nullopt);
  EXPECT_EQ(Nees({.T_a_b = {}, .covariance = Eigen::Matrix3d::Constant(std::nan(""))}, {}),
            std::nullopt);
}

TEST(NeesSummary, GivesTheMeanAndItsInterval) {
  const NeesSummary summary = SummarizeNees(std::vector<double>{1.0, 3.0, 2.0, 10.0});
  EXPECT_DOUBLE_EQ(summary.mean, 4.0);
  // Sample variance 50 / 3, of the mean 50 / 12.
  EXPECT_NEAR(summary.mean_high - summary.mean, 1.959964 * std::sqrt(50.0 / 12.0), 1e-6);
  EXPECT_NEAR(summary.mean - summary.mean_low, 1.959964 * std::sqrt(50.0 / 12.0), 1e-6);
  // Tabulated chi-square quantiles with 12 degrees of freedom: 4.404 and 23.337.
  EXPECT_NEAR(summary.consistent_low, 4.404 / 4.0, 0.01 * 4.404 / 4.0);
  EXPECT_NEAR(summary.consistent_high, 23.337 / 4.0, 0.01 * 23.337 / 4.0);
  EXPECT_DOUBLE_EQ(summary.share_in_95_percent_ellipsoid, 0.75);
}

TEST(CarryByOdometry, BlendsFromBothSides) {
  // Odometry goes 3 m straight ahead; the map says it was 3.3 m, starting at (10, 0) and heading
  // north.
  const std::vector<CarriedReading> readings = {
      {.stamp = seconds(0), .T_odom_robot = {-1, 0, 0}},  // Before the first estimate: no pose.
      {.stamp = seconds(1), .T_odom_robot = {0, 0, 0}, .T_map_robot = Pose2{10, 0, pi / 2}},
      {.stamp = seconds(2), .T_odom_robot = {1, 0, 0}},
      {.stamp = seconds(3), .T_odom_robot = {2, 0, 0}},
      {.stamp = seconds(4), .T_odom_robot = {3, 0, 0}, .T_map_robot = Pose2{10, 3.3, pi / 2}},
      {.stamp = seconds(5), .T_odom_robot = {4, 0, 0}}};
  const Trajectory carried = CarryByOdometry(readings);
  ASSERT_EQ(carried.size(), 5U);
  const std::vector<double> expected_y_m = {0.0, 1.1, 2.2, 3.3, 4.3};
  for (std::size_t i = 0; i < carried.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(carried[i].stamp, seconds(static_cast<int>(i) + 1));
    EXPECT_NEAR(carried[i].T_map_robot.x_m, 10.0, 1e-12);
    EXPECT_NEAR(carried[i].T_map_robot.y_m, expected_y_m[i], 1e-12);
    EXPECT_NEAR(carried[i].T_map_robot.theta_rad, pi / 2, 1e-12);
  }
}

}  // namespace
}  // namespace qwsm
