// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Several narrow lasers beside one that looks all around, on the same five drives through an office
// with people, as answered and, in brackets, as corrected in the end. The errors are printed: this
// is the evaluation that docs/results.md tells of.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/trajectory_error.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPeriod_s = 0.1;
constexpr double kDuration_s = 90.0;
// Of two millimetres, by which five drives tell the mean to a fifth.
constexpr double kMostOfOneCorrected = 1.4;
constexpr double kMostOfOneLaser = 1.1;  // Times the error of one laser that looks all around.

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

/// Errors of a path as answered, and as corrected in the end.
struct Errors {
  double answered_m = 0.0;
  double corrected_m = 0.0;

  Errors& operator+=(const Errors& other) {
    answered_m += other.answered_m;
    corrected_m += other.corrected_m;
    return *this;
  }
};

double AteRmse_m(std::span<const PosePair> pairs) {
  return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
}

/// Of several answers for one moment, as two lasers get, the last counts: it is by all that was
/// seen.
Errors ErrorsOf(const sim::ScenarioOptions& scenario) {
  sim::Simulation simulation(scenario);
  SelfCorrectingMapper mapper;
  std::vector<PosePair> pairs;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    const MappingStep step =
        mapper.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    pairs.push_back({.stamp = step.stamp,
                     .T_ref_robot = reading->T_world_robot,
                     .T_map_robot = step.map_robot.T_a_b});
  }
  const std::vector<UncertainPose2> corrected = mapper.Correct().map_robot;
  std::vector<PosePair> answered_pairs;
  std::vector<PosePair> corrected_pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i + 1 < pairs.size() && pairs[i + 1].stamp == pairs[i].stamp) continue;
    answered_pairs.push_back(pairs[i]);
    corrected_pairs.push_back(pairs[i]);
    corrected_pairs.back().T_map_robot = corrected[i].T_a_b;
  }
  return {.answered_m = AteRmse_m(answered_pairs), .corrected_m = AteRmse_m(corrected_pairs)};
}

/// The mean errors of five drives.
Errors ErrorsOf(const char* what, const Mount& mount) {
  constexpr int kDrives = 5;
  Errors sum;
  std::printf("%-32s", what);
  for (int seed = 1; seed <= kDrives; ++seed) {
    sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
    scenario.duration_s = kDuration_s;
    scenario.layout.office.rooms_per_side = 4;
    scenario.layout.office.persons = 3;
    mount(scenario.robots[0]);
    const Errors errors = ErrorsOf(scenario);
    std::printf(" %5.2f (%5.2f)", 1e3 * errors.answered_m, 1e3 * errors.corrected_m);
    sum += errors;
  }
  const Errors mean{.answered_m = sum.answered_m / kDrives,
                    .corrected_m = sum.corrected_m / kDrives};
  std::printf("  mean %5.2f (%5.2f) mm\n", 1e3 * mean.answered_m, 1e3 * mean.corrected_m);
  return mean;
}

void ExpectAsGood(const Errors& errors, const Errors& one) {
  EXPECT_LT(errors.answered_m, kMostOfOneLaser * one.answered_m);
  EXPECT_LT(errors.corrected_m, kMostOfOneCorrected * one.corrected_m);
}

TEST(SeveralLasers, TwoBackToBackAreAsGoodAsOneThatLooksAllAround) {
  const Errors one = ErrorsOf("one of 360 degrees", AllAround);
  const Errors half = ErrorsOf("one of 180 degrees", OnlyAhead);
  EXPECT_GT(half.answered_m, 1.5 * one.answered_m) << "it is two that it takes";
  ExpectAsGood(ErrorsOf("two of 180, at the same time", BackToBack(0.0)), one);
  ExpectAsGood(ErrorsOf("two of 180, half a period apart", BackToBack(0.5 * kPeriod_s)), one);
  ExpectAsGood(ErrorsOf("and a third that breaks", WithAThird()), one);
}

}  // namespace
}  // namespace qwsm::test
