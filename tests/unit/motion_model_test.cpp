// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/motion_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace qwsm {
namespace {

constexpr double kStep_m = 0.1;
constexpr double kMatchSigma = 0.002;  // m, rad.

/// A robot that drives straight ahead by steps, with odometry off by `error_sigma` (m, rad).
class Drive {
 public:
  explicit Drive(MotionModel& model) : model_(model) { model_.Remember({}, odometry_); }

  /// @param sigmas of where each pose is found to be, in m, m, rad.
  void Go(int steps, double error_sigma, const Eigen::Vector3d& sigmas) {
    const Eigen::Matrix3d found_covariance = sigmas.cwiseAbs2().asDiagonal();
    for (int step = 0; step < steps; ++step) {
      const Pose2 told{kStep_m + error_sigma * normal_(random_),
                       error_sigma * normal_(random_),
                       error_sigma * normal_(random_)};
      odometry_ = odometry_ * told;
      const UncertainPose2 found{.T_a_b = {kStep_m, 0.0, 0.0}, .covariance = found_covariance};
      model_.Adapt(model_.Predict(odometry_).adapted, found, odometry_);
      model_.Remember(found.T_a_b, odometry_);
    }
  }

  PosePrediction Next() const { return model_.Predict(odometry_ * Pose2{kStep_m, 0.0, 0.0}); }

 private:
  MotionModel& model_;
  Pose2 odometry_;
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

double SigmaAlong(const UncertainPose2& pose) { return std::sqrt(pose.covariance(0, 0)); }
double SigmaAcross(const UncertainPose2& pose) { return std::sqrt(pose.covariance(1, 1)); }

const Eigen::Vector3d kToldEverywhere(kMatchSigma, kMatchSigma, kMatchSigma);
const Eigen::Vector3d kToldAcrossOnly(10.0 * kMatchSigma, kMatchSigma, kMatchSigma);

TEST(MotionModel, AdaptsToHowGoodOdometryIs) {
  MotionModel model;
  Drive drive(model);
  const PosePrediction before = drive.Next();
  drive.Go(300, 0.008, kToldEverywhere);
  const PosePrediction after = drive.Next();
  EXPECT_EQ(SigmaAlong(before.adapted), SigmaAlong(before.conservative));
  EXPECT_NEAR(SigmaAlong(after.adapted), 0.008, 0.004);
  EXPECT_NEAR(SigmaAcross(after.adapted), 0.008, 0.004);
  // The wheels may slip all the same.
  EXPECT_NEAR(SigmaAlong(after.conservative), SigmaAlong(before.conservative), 1e-9);
}

TEST(MotionModel, BelievesOdometryLessThatIsWorseThanModelled) {
  MotionModel model;
  Drive drive(model);
  const PosePrediction before = drive.Next();
  drive.Go(300, 0.15, kToldEverywhere);
  EXPECT_GT(SigmaAlong(drive.Next().conservative), 2.0 * SigmaAlong(before.conservative));
}

TEST(MotionModel, DoesNotAdaptToADirectionThatPairsTellLittleOf) {
  MotionModel model;
  Drive drive(model);
  const PosePrediction before = drive.Next();
  drive.Go(300, 0.15, kToldAcrossOnly);
  const PosePrediction after = drive.Next();
  EXPECT_NEAR(SigmaAlong(after.adapted), SigmaAlong(before.adapted), 1e-6);
  EXPECT_GT(SigmaAcross(after.adapted), 1.5 * SigmaAcross(before.adapted));
}

TEST(MotionModel, WithoutOdometryExpectsTheLastMotionAndIsMoreUncertain) {
  MotionModel model;
  model.Remember({kStep_m, 0.02, 0.1}, std::nullopt);
  const PosePrediction predicted = model.Predict(std::nullopt);
  EXPECT_EQ(predicted.conservative.T_a_b, (Pose2{kStep_m, 0.02, 0.1}));
  EXPECT_EQ(predicted.adapted.T_a_b, predicted.conservative.T_a_b);
  EXPECT_GT(SigmaAlong(predicted.conservative), MotionNoise{}.translation_floor_m);
}

TEST(MotionModel, IsSurprisedByOdometryThatJumps) {
  MotionModel model;
  EXPECT_FALSE(model.IsSurprising(Pose2{.x_m = 5.0}));
  model.Remember({.x_m = 0.1}, Pose2{.x_m = 1.0});
  EXPECT_FALSE(model.IsSurprising(std::nullopt));
  EXPECT_FALSE(model.IsSurprising(Pose2{.x_m = 1.2}));
  EXPECT_TRUE(model.IsSurprising(Pose2{.x_m = 3.0}));
  EXPECT_TRUE(model.IsSurprising(Pose2{.x_m = 1.1, .theta_rad = 1.2}));
}

}  // namespace
}  // namespace qwsm
