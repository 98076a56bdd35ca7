// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/gyro_track.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace qwsm {
namespace {

using namespace std::chrono_literals;

ImuReading Turning(Timestamp stamp, double rate_rad_s) {
  return {.stamp = stamp, .turn_rate_rad_s = {0.0, 0.0, rate_rad_s}};
}

TEST(GyroTrack, SumsUpTurnsBetweenReadings) {
  GyroTrack track;
  for (int i = 0; i <= 10; ++i) track.Add(Turning(1s + i * 10ms, 0.1 * i));
  EXPECT_NEAR(*track.At(1100ms) - *track.At(1s), 0.05, 1e-12);
  EXPECT_NEAR(*track.At(1005ms) - *track.At(1s), 0.00025, 1e-12);
  EXPECT_FALSE(track.At(999ms));
  EXPECT_FALSE(track.At(1101ms));
  EXPECT_TRUE(track.Covers(1100ms));
  EXPECT_FALSE(track.Covers(1101ms));
}

TEST(GyroTrack, TellsNothingOfGapsAndTakesNothingTwice) {
  GyroTrack track;
  EXPECT_TRUE(track.Add(Turning(1s, 1.0)));
  EXPECT_FALSE(track.Add(Turning(1s, 9.0)));
  EXPECT_FALSE(track.Add(Turning(900ms, 9.0)));
  EXPECT_TRUE(track.Add(Turning(1500ms, 1.0)));
  EXPECT_FALSE(track.At(1200ms));
  EXPECT_EQ(track.At(1500ms), 0.5);
}

TEST(ImuReading, IsRefusedWithOneComponentThatIsNoNumber) {
  for (int axis = 0; axis < 3; ++axis) {
    ImuReading turning{.acceleration_mps2 = Eigen::Vector3d{0.0, 0.0, 9.8}};
    EXPECT_EQ(ObjectionTo(turning), "");
    turning.turn_rate_rad_s[axis] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(ObjectionTo(turning), "") << axis;
    ImuReading accelerating{.acceleration_mps2 = Eigen::Vector3d::Zero()};
    (*accelerating.acceleration_mps2)[axis] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(ObjectionTo(accelerating), "") << axis;
  }
}

TEST(GyroTrack, GoesOnWhereItsClockIsSetBack) {
  GyroTrack track(2);
  for (int i = 0; i < 5; ++i) track.Add(Turning(10s + i * 100ms, 1.0));
  EXPECT_FALSE(track.At(10s)) << "only the last two are kept";
  const double before_rad = *track.At(10400ms);
  track.Restart();
  EXPECT_TRUE(track.empty());
  EXPECT_TRUE(track.Add(Turning(1s, 1.0)));
  EXPECT_EQ(track.At(1s), before_rad);
}

TEST(ImuReading, IsTurnedToTheRobotsAxes) {
  const ImuReading felt{.stamp = 1s,
                        .turn_rate_rad_s = {0.1, 0.2, 0.3},
                        .acceleration_mps2 = Eigen::Vector3d(0.0, 9.81, 0.0)};
  // On its side: its y axis points up.
  const double half = std::sqrt(0.5);
  const ImuReading turned = OnRobot(felt, {.x = half, .y = 0.0, .z = 0.0, .w = half});
  EXPECT_NEAR((turned.turn_rate_rad_s - Eigen::Vector3d(0.1, -0.3, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((*turned.acceleration_mps2 - Eigen::Vector3d(0.0, 0.0, 9.81)).norm(), 0.0, 1e-12);
  EXPECT_EQ(OnRobot(felt, {}).turn_rate_rad_s, felt.turn_rate_rad_s) << "to the last bit";
}

}  // namespace
}  // namespace qwsm
