// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bags whose scans were taken in motion, played to a service.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/replay.hpp"
#include "tests/support/team_bag.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::test {
namespace {

struct Robot {
  const char* name;
  bool has_odometry;
  bool has_gyro;
};

void PrintTo(const Robot& robot, std::ostream* stream) { *stream << robot.name; }

/// A robot that drives through rooms, its laser scanning all the time.
std::vector<sim::Reading> DriveOf(const Robot& robot) {
  sim::ScenarioOptions scenario;
  scenario.duration_s = 30.0;
  scenario.layout.kind = sim::LayoutKind::kOffice;
  sim::RobotOptions options;
  options.gyro.enabled = robot.has_gyro;
  options.laser.beams = 361;
  options.laser.field_of_view_rad = 2.0 * std::numbers::pi;
  options.laser.rate_hz = 10.0;
  options.laser.sweep_s = 0.09;
  scenario.robots = {options};
  std::vector<sim::Reading> readings = ReadingsOf(scenario, 1);
  // What the gyro felt until the end of the last scan that is left.
  std::ranges::copy(readings.back().imu, std::back_inserter((readings.end() - 2)->imu));
  readings.pop_back();
  return readings;
}

class DdsSweep : public ::testing::TestWithParam<Robot> {
 protected:
  void SetUp() override {
    const std::array<std::string, 1> names{"robot1"};
    const auto odometry = GetParam().has_odometry ? OdometryOfBag::kWritten : OdometryOfBag::kNone;
    WriteTeamBag(DriveOf(GetParam()), names, Path("drive.mcap"), odometry);
  }

  std::string Path(const std::string& name) const { return folder_.path() / name; }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_P(DdsSweep, OfABagGivesItsPathBitForBit) {
  ASSERT_NO_FATAL_FAILURE(MapOverNetworkAndFromFile(network_, Path("drive.mcap"), folder_.path()));
  ExpectSamePath(Path("served"), Path("mapped"));
}

TEST_P(DdsSweep, IsKeptWhereABagIsConvertedToAnother) {
  const Outcome converted =
      RunProgram({"convert", Path("drive.mcap"), "-o", Path("converted.mcap")});
  ASSERT_EQ(converted.exit_code, 0) << converted.errors;
  for (const char* bag : {"drive", "converted"}) {
    const Outcome mapped =
        RunProgram({"map", Path(bag) + ".mcap", "--no-pictures", "--output", Path(bag)});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  }
  EXPECT_TRUE(ReadFile(Path("converted/trajectory_live.tum")) ==
              ReadFile(Path("drive/trajectory_live.tum")));
}

INSTANTIATE_TEST_SUITE_P(Robots,
                         DdsSweep,
                         ::testing::Values(Robot{"Wheels", true, false},
                                           Robot{"Gyro", true, true},
                                           Robot{"NoOdometry", false, false}),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace qwsm::test
