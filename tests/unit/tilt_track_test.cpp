// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/tilt_track.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

namespace qwsm {
namespace {

using namespace std::chrono_literals;

/// A shaken sensor on a robot that stands level.
class LevelImu {
 public:
  ImuReading Read(Timestamp stamp, double roll_rate_rad_s = 0.0) {
    std::normal_distribution<double> noise(0.0, 0.2);
    ImuReading reading{.stamp = stamp, .turn_rate_rad_s = {roll_rate_rad_s, 0.0, 0.0}};
    reading.acceleration_mps2 =
        Eigen::Vector3d(noise(random_), noise(random_), 9.81 + noise(random_));
    return reading;
  }

 private:
  std::mt19937 random_{1};
};

double Lean_rad(const Tilt& tilt) {
  return std::atan2(tilt.up_robot.head<2>().norm(), tilt.up_robot.z());
}

// A robot that rocks a little when a reading comes again has not turned over while none came.
TEST(TiltTrack, TakesNoTurnForOneThatWentOnDuringAGap) {
  constexpr auto kStep = 10ms;
  for (const auto gap : {500ms, 5000ms, 60000ms}) {
    SCOPED_TRACE(gap.count());
    LevelImu imu;
    TiltTrack track;
    Timestamp now = 1s;
    for (int i = 0; i < 2000; ++i) track.Add(imu.Read(now += kStep));
    track.Add(imu.Read(now += gap, 0.3));
    for (int i = 0; i < 1000; ++i) {
      track.Add(imu.Read(now += kStep));
      const Tilt tilt = *track.At(now);
      ASSERT_LT(Lean_rad(tilt), 3.0 * tilt.sigma_rad) << "clear after " << i;
    }
    EXPECT_LT(track.At(now)->sigma_rad, 0.02);
  }
}

TEST(TiltTrack, TellsNothingWithinAGap) {
  LevelImu imu;
  TiltTrack track;
  track.Add(imu.Read(1s));
  track.Add(imu.Read(2s));
  EXPECT_FALSE(track.At(1500ms));
  EXPECT_TRUE(track.At(2s));
}

}  // namespace
}  // namespace qwsm
