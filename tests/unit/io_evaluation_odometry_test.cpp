// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <string>

#include "service/io/logs/evaluation_odometry.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

// Two scans, the first at a reading of odometry, and readings before, between and after them.
constexpr const char* kLog =
    "ODOM 0 0 0 0 0 0 1.0 h 0\n"
    "ODOM 1 0 0 0 0 0 2.0 h 0\n"
    "FLASER 1 2.0 1 0 0 1 0 0 2.0 h 0\n"
    "ODOM 2 0 0 0 0 0 3.0 h 0\n"
    "ODOM 3 0 0 0 0 0 3.5 h 0\n"
    "FLASER 1 2.0 4 0 0 4 0 0 4.0 h 0\n"
    "ODOM 5 0 0 0 0 0 5.0 h 0\n";

Trajectory Carry(const std::string& log, const Trajectory& trajectory) {
  std::istringstream stream(log);
  return CarryToOdometry(*OpenLog(stream, "test.log"), trajectory);
}

TEST(CarryToOdometry, FadesTheCorrectionFromScanToScan) {
  const Trajectory dense = Carry(kLog, {{2s, {1.0, 0.0, 0.0}}, {4s, {4.3, 0.0, 0.0}}});
  ASSERT_EQ(dense.size(), 5U);
  const double expected_x_m[] = {1.0, 2.1, 3.2, 4.3, 5.3};
  const Timestamp expected_stamps[] = {2s, 3s, 3500ms, 4s, 5s};
  for (std::size_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(dense[i].stamp, expected_stamps[i]);
    EXPECT_NEAR(dense[i].T_map_robot.x_m, expected_x_m[i], 1e-12);
  }
}

TEST(CarryToOdometry, TakesScansWithoutAPoseAsOdometry) {
  const Trajectory dense = Carry(kLog, {{2s, {1.0, 0.5, 0.0}}});
  ASSERT_EQ(dense.size(), 5U);
  EXPECT_EQ(dense[3].stamp, 4s);
  EXPECT_EQ(dense[3].T_map_robot, (Pose2{4.0, 0.5, 0.0}));
}

TEST(CarryToOdometry, KeepsPosesOfScansWithoutOdometry) {
  const Trajectory dense =
      Carry("RAWLASER1 0 -1.5 3 1.5 8 0.01 0 3 1 1 1 0 1.5 h 0\n", {{1500ms, {1.0, 2.0, 0.5}}});
  ASSERT_EQ(dense.size(), 1U);
  EXPECT_EQ(dense[0], (StampedPose2{1500ms, {1.0, 2.0, 0.5}}));
}

TEST(CarryToOdometry, RefusesATrajectoryOfAnotherLog) {
  EXPECT_THROW(Carry(kLog, {{2s, {}}, {4100ms, {}}}), std::runtime_error);
  EXPECT_THROW(Carry(kLog, {{4s, {}}, {2s, {}}}), std::runtime_error);
}

}  // namespace
}  // namespace qwsm::io
