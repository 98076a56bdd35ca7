// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Several narrow lasers beside one that looks all around, on the same five drives through an office
// with people. The errors are printed: this is the evaluation that docs/results.md tells of.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>

#include "tests/support/mapped_drive.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPeriod_s = 0.1;
constexpr double kDuration_s = 90.0;
constexpr double kMost = 1.1;  // Times the error of one laser that looks all around.

using Mount = std::function<void(sim::RobotOptions&)>;

sim::LaserOptions HalfAround(double mount_x_m, double heading_rad, double first_scan_s) {
  sim::LaserOptions laser;
  laser.rate_hz = 1.0 / kPeriod_s;
  laser.first_scan_s = first_scan_s;
  laser.useful_range_m = 30.0;
  laser.mount_x_m = mount_x_m;
  laser.mount_heading_rad = heading_rad;
  return laser;
}

void AllAround(sim::RobotOptions& robot) {
  robot.laser = HalfAround(0.0, 0.0, 0.0);
  robot.laser.beams = 361;
  robot.laser.field_of_view_rad = 2.0 * kPi;
}

void OnlyAhead(sim::RobotOptions& robot) { robot.laser = HalfAround(0.2, 0.0, 0.0); }

/// One at the front and one at the back, which fires so much later.
Mount BackToBack(double later_s) {
  return [later_s](sim::RobotOptions& robot) {
    robot.laser = HalfAround(0.2, 0.0, 0.0);
    robot.more_lasers = {HalfAround(-0.2, kPi, later_s)};
  };
}

/// The same with a third one that looks to the left until it breaks.
Mount WithAThird() {
  return [](sim::RobotOptions& robot) {
    BackToBack(0.5 * kPeriod_s)(robot);
    robot.more_lasers.push_back(HalfAround(0.0, 0.5 * kPi, 0.25 * kPeriod_s));
    robot.more_lasers.back().breaks_at_s = 0.5 * kDuration_s;
  };
}

/// The mean error of five drives.
double ErrorOf_m(const char* what, const Mount& mount) {
  constexpr int kDrives = 5;
  double sum_m = 0.0;
  std::printf("%-34s", what);
  for (int seed = 1; seed <= kDrives; ++seed) {
    sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
    scenario.duration_s = kDuration_s;
    scenario.layout.office.rooms_per_side = 4;
    scenario.layout.office.persons = 3;
    mount(scenario.robots[0]);
    const double error_m = MappedDrive(scenario).AteRmse_m();
    std::printf(" %5.2f", 1e3 * error_m);
    sum_m += error_m;
  }
  std::printf("  mean %5.2f mm\n", 1e3 * sum_m / kDrives);
  return sum_m / kDrives;
}

TEST(SeveralLasers, TwoBackToBackAreAsGoodAsOneThatLooksAllAround) {
  const double one_m = ErrorOf_m("one of 360 degrees", AllAround);
  EXPECT_GT(ErrorOf_m("one of 180 degrees", OnlyAhead), 1.5 * one_m) << "it is two that it takes";
  EXPECT_LT(ErrorOf_m("two of 180, at the same time", BackToBack(0.0)), kMost * one_m);
  const double two_m = ErrorOf_m("two of 180, half a period apart", BackToBack(0.5 * kPeriod_s));
  EXPECT_LT(two_m, kMost * one_m);
  EXPECT_LT(ErrorOf_m("and a third that breaks", WithAThird()), kMost * two_m);
}

}  // namespace
}  // namespace qwsm::test
