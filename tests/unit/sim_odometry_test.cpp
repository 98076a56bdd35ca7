// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/gyro.hpp"
#include "sim/odometry.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

constexpr WheelDriveOptions kTwoWheels{.type = DriveType::kDifferential, .track_m = 0.4};

constexpr CalibrationOptions kExact{.scale_sigma = 0.0, .balance_sigma = 0.0, .turn_sigma = 0.0};

TEST(WheelOdometry, FollowsACircle) {
  WheelOdometry odometry(
      {.ticks_per_turn = 10000000, .travel_noise_m = 0.0, .calibration = kExact}, kTwoWheels, 1);
  // A quarter of a circle of 1 m radius in one second.
  const double arc_m = 0.5 * std::numbers::pi;
  for (int step = 0; step < 100; ++step) odometry.Advance({0.8 * arc_m, 1.2 * arc_m}, 10ms);
  EXPECT_NEAR(odometry.T_odom_robot().x_m, 1.0, 1e-4);
  EXPECT_NEAR(odometry.T_odom_robot().y_m, 1.0, 1e-4);
  EXPECT_NEAR(odometry.T_odom_robot().theta_rad, 0.5 * std::numbers::pi, 1e-4);
}

TEST(WheelOdometry, MovesByWholeEncoderStepsAndLosesNone) {
  constexpr int kTicks = 100;
  const double tick_m = 2.0 * std::numbers::pi * kTwoWheels.wheel_radius_m / kTicks;
  WheelOdometry odometry(
      {.ticks_per_turn = kTicks, .travel_noise_m = 0.0, .calibration = kExact}, kTwoWheels, 1);
  for (int step = 1; step <= 1000; ++step) {
    odometry.Advance({0.1, 0.1}, 10ms);
    const double ticks = odometry.T_odom_robot().x_m / tick_m;
    EXPECT_NEAR(ticks, std::round(ticks), 1e-6);
    EXPECT_NEAR(odometry.T_odom_robot().x_m, 0.001 * step, tick_m);
  }
}

TEST(WheelOdometry, NoiseGrowsWithTheRootOfTheDistance) {
  constexpr int kRuns = 400;
  constexpr double kDistance_m = 4.0;
  double squares_m2 = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    WheelOdometry odometry(
        {.ticks_per_turn = 1000000, .travel_noise_m = 0.01, .calibration = kExact},
        kTwoWheels,
        seed);
    for (int step = 0; step < 400; ++step) odometry.Advance({1.0, 1.0}, 10ms);
    // The difference of the two sides turns the robot by itself over the track.
    const double turned_m = odometry.T_odom_robot().theta_rad * kTwoWheels.track_m;
    squares_m2 += turned_m * turned_m;
  }
  const double expected_m2 = 2.0 * 0.01 * 0.01 * kDistance_m;
  EXPECT_NEAR(squares_m2 / kRuns / expected_m2, 1.0, 4.0 * std::sqrt(2.0 / kRuns));
}

TEST(WheelOdometry, WrongRadiusShowsAsScaleAndCurve) {
  WheelOdometry odometry({.ticks_per_turn = 1000000,
                          .travel_noise_m = 0.0,
                          .right_radius_error = 0.02,
                          .calibration = kExact},
                         kTwoWheels,
                         1);
  for (int step = 0; step < 100; ++step) odometry.Advance({1.0, 1.0}, 10ms);
  EXPECT_NEAR(odometry.T_odom_robot().theta_rad, 0.02 / kTwoWheels.track_m, 1e-4);
  EXPECT_NEAR(odometry.T_odom_robot().translation_m().norm(), 1.01, 1e-3);
}

TEST(WheelOdometry, IsCalibratedAsWellAsItsOptionsSay) {
  constexpr int kRobots = 400;
  const OdometryOptions options{
      .ticks_per_turn = 1000000,
      .travel_noise_m = 0.0,
      .calibration = {.scale_sigma = 0.01, .balance_sigma = 0.004, .turn_sigma = 0.02}};
  double scale2 = 0.0;
  double balance2 = 0.0;
  double turn2 = 0.0;
  for (std::uint64_t seed = 0; seed < kRobots; ++seed) {
    WheelOdometry ahead(options, kTwoWheels, seed);
    for (int step = 0; step < 100; ++step) ahead.Advance({1.0, 1.0}, 10ms);
    WheelOdometry on_the_spot(options, kTwoWheels, seed);
    for (int step = 0; step < 100; ++step) on_the_spot.Advance({-0.2, 0.2}, 10ms);
    scale2 += std::pow(ahead.T_odom_robot().translation_m().norm() - 1.0, 2);
    balance2 += std::pow(ahead.T_odom_robot().theta_rad * kTwoWheels.track_m, 2);
    turn2 += std::pow(on_the_spot.T_odom_robot().theta_rad - 1.0, 2);
  }
  const double tolerance = 4.0 / std::sqrt(2.0 * kRobots);
  EXPECT_NEAR(std::sqrt(scale2 / kRobots) / 0.01, 1.0, tolerance);
  EXPECT_NEAR(std::sqrt(balance2 / kRobots) / 0.004, 1.0, tolerance);
  // What is too far is also turned too far.
  EXPECT_NEAR(std::sqrt(turn2 / kRobots) / std::hypot(0.01, 0.02), 1.0, tolerance);
}

TEST(Gyro, IsBiasedAndNoisyAsItsOptionsSay) {
  constexpr int kRuns = 400;
  double sum_rad = 0.0;
  double squares_rad2 = 0.0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Gyro gyro({.enabled = true,
               .noise_rad_per_sqrt_s = 0.01,
               .bias_rad_s = 0.003,
               .bias_walk_rad_s = 0.0},
              seed);
    for (int step = 0; step < 400; ++step) gyro.Advance(0.2, 10ms);
    const double error_rad = gyro.turned_rad() - 0.8;
    sum_rad += error_rad;
    squares_rad2 += (error_rad - 0.012) * (error_rad - 0.012);
  }
  EXPECT_NEAR(sum_rad / kRuns, 0.012, 4.0 * 0.02 / std::sqrt(kRuns));
  EXPECT_NEAR(std::sqrt(squares_rad2 / kRuns), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * kRuns));
}

}  // namespace
}  // namespace sim
