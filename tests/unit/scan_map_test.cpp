// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_map.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// Scans of a room from its middle, each with other noise.
class MapOfARoom : public testing::Test {
 protected:
  LaserScan NextScan() {
    const World room{.walls = {{.from_m = {-4.0, -3.0}, .to_m = {4.0, -3.0}},
                               {.from_m = {4.0, -3.0}, .to_m = {4.0, 3.0}},
                               {.from_m = {4.0, 3.0}, .to_m = {-4.0, 3.0}},
                               {.from_m = {-4.0, 3.0}, .to_m = {-4.0, -3.0}}},
                     .columns = {}};
    return Measure({.beams = 181, .range_max_m = 20.0}, room, Pose2{}, random_);
  }

  void Insert(double sigma_m) {
    const LaserScan scan = NextScan();
    map_.Insert(scan, ToPoints(scan), {.T_a_b = {}, .covariance = Variance(sigma_m)});
  }

  static Eigen::Matrix3d Variance(double sigma_m) {
    return sigma_m * sigma_m * Eigen::Matrix3d::Identity();
  }

  Eigen::Matrix3d CovarianceUnderAScan() {
    return map_.CovarianceUnder(ToPoints(NextScan()), {}).about_origin;
  }

  ScanMap map_;
  std::mt19937_64 random_{5};
};

TEST_F(MapOfARoom, HasTheErrorOfItsOnlyScan) {
  Insert(0.03);
  EXPECT_TRUE(CovarianceUnderAScan().isApprox(Variance(0.03)));
}

TEST_F(MapOfARoom, TakesErrorsOverThatItsScansShare) {
  Insert(0.03);
  Insert(0.03);  // Added nothing of its own.
  EXPECT_TRUE(CovarianceUnderAScan().isApprox(Variance(0.03)));
}

TEST_F(MapOfARoom, AveragesOutWhatItsScansAddOfTheirOwn) {
  Insert(0.01);
  Insert(0.02);
  Insert(0.02);
  const double variance_m2 = CovarianceUnderAScan()(0, 0);
  EXPECT_GT(variance_m2, 0.01 * 0.01);
  const double mean_m2 = (0.01 * 0.01 + 2.0 * 0.02 * 0.02) / 3.0;
  EXPECT_LT(variance_m2, 0.9 * mean_m2);
}

TEST_F(MapOfARoom, IsAsUncertainAsItsLastScanWhereNothingIsNear) {
  Insert(0.01);
  Insert(0.05);
  const LaserScan scan = NextScan();
  const Pose2 elsewhere{100.0, 0.0, 0.0};
  const Eigen::Matrix3d covariance = map_.CovarianceUnder(ToPoints(scan), elsewhere).about_origin;
  EXPECT_TRUE(covariance.isApprox(Variance(0.05)));
}

TEST_F(MapOfARoom, IsMadeAnewOfItsScans) {
  Insert(0.01);
  Insert(0.02);
  const ScanMap anew = MapOf({map_.scans().begin(), map_.scans().end()}, map_.options());
  ASSERT_EQ(anew.scans().size(), 2U);
  EXPECT_EQ(anew.scans()[1].id, 1U);
  EXPECT_EQ(anew.scans()[1].map_robot.covariance, Variance(0.02));
  EXPECT_EQ(anew.surfaces().quadtree().Positions(), map_.surfaces().quadtree().Positions());
  const std::vector<ScanPoint> points = ToPoints(NextScan());
  EXPECT_EQ(anew.CovarianceUnder(points, {}).about_origin,
            map_.CovarianceUnder(points, {}).about_origin);
}

// As in the coordinates of a country's survey.
TEST_F(MapOfARoom, KnowsItsErrorsFarFromTheOrigin) {
  const Pose2 far_off{5e5, 5.4e6, 0.0};
  for (const double sigma_rad : {0.05, 0.051, 0.052}) {
    const LaserScan scan = NextScan();
    map_.Insert(scan, ToPoints(scan), UncertainPose2::WithSigmas(far_off, 0.1, sigma_rad));
  }
  const FrameCovariance under = map_.CovarianceUnder(ToPoints(NextScan()), far_off);
  const Eigen::Matrix3d there = under.At(far_off.translation_m());
  EXPECT_NEAR(there(0, 0), 0.1 * 0.1, 1e-3);
  EXPECT_NEAR(there(1, 1), 0.1 * 0.1, 1e-3);
  EXPECT_NEAR(there(2, 2), 0.05 * 0.05, 1e-4);
}

}  // namespace
}  // namespace qwsm::test
