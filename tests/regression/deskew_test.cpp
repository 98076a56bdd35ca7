// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that turns at 2 rad/s while its laser scans, ten times a second and all the time, beside
// one whose scans are taken at once. The errors are printed: docs/results.md tells of them.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/metrics/trajectory_error.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

constexpr double kTurn_rad_s = 2.0;
constexpr double kSweep_s = 0.1;
constexpr double kMost = 1.2;  // Times the error of scans that are taken at once.
// It begins to slip, from one scan to the next, as it sets off.
constexpr double kMostSlipping = 1.3;
constexpr int kDrives = 5;

using Tell = std::function<Observation(const sim::Reading&)>;

/// A robot that turns on the spot, in a corridor of an office, for half a minute.
sim::ScenarioOptions Turning(int seed, double sweep_s, bool has_gyro) {
  sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
  scenario.duration_s = 30.0;
  scenario.layout.office.persons = 0;  // They would bump into it.
  sim::RobotOptions& robot = scenario.robots[0];
  robot.driver.kind = sim::DriverKind::kExternal;
  robot.start_x_m = 8.0;
  robot.gyro.enabled = has_gyro;
  robot.laser.useful_range_m = 30.0;
  robot.laser.beams = 361;
  robot.laser.field_of_view_rad = 2.0 * std::numbers::pi;
  robot.laser.sweep_s = sweep_s;
  return scenario;
}

double ErrorOf_m(const sim::ScenarioOptions& scenario, double forward_mps, const Tell& tell) {
  sim::Simulation simulation(scenario);
  simulation.SetCommand(0, {.forward_mps = forward_mps, .turn_rad_s = kTurn_rad_s});
  Mapper mapper;
  std::vector<PosePair> pairs;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    const MappingStep step = mapper.Process(tell(*reading));
    pairs.push_back({.stamp = step.stamp,
                     .T_ref_robot = reading->T_world_robot,
                     .T_map_robot = step.map_robot.T_a_b});
  }
  return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
}

/// How scans are taken, and what is made of them.
struct Way {
  const char* name;
  double sweep_s;
  bool has_gyro;
  Tell tell;
};

double MeanErrorOf_m(const Way& way, double forward_mps) {
  double sum_m = 0.0;
  std::printf("  %-34s", way.name);
  for (int seed = 1; seed <= kDrives; ++seed) {
    const double error_m =
        ErrorOf_m(Turning(seed, way.sweep_s, way.has_gyro), forward_mps, way.tell);
    std::printf(" %5.2f", 1e3 * error_m);
    sum_m += error_m;
  }
  std::printf("  mean %5.2f mm\n", 1e3 * sum_m / kDrives);
  return sum_m / kDrives;
}

Observation AsMeasured(const sim::Reading& reading) {
  return {.scan = reading.scan, .T_odom_robot = reading.T_odom_robot, .gyro_rad = reading.gyro_rad};
}

const Way kAtOnce{"at once", 0.0, false, AsMeasured};
const Way kSkewed{"in 0.1 s, as measured", kSweep_s, false, AsMeasured};
const Way kByWheels{"in 0.1 s, from one place by wheels", kSweep_s, false, sim::ObservationOf};
const Way kByGyro{"and by the gyro", kSweep_s, true, sim::ObservationOf};

TEST(Deskew, OnTheSpotScansAreAsGoodAsThoseTakenAtOnce) {
  std::printf("turning on the spot\n");
  const double at_once_m = MeanErrorOf_m(kAtOnce, 0.0);
  const double skewed_m = MeanErrorOf_m(kSkewed, 0.0);
  EXPECT_GT(skewed_m, 2.0 * at_once_m) << "there is nothing to mend";
  EXPECT_LT(MeanErrorOf_m(kByWheels, 0.0), 1.3 * at_once_m);
  EXPECT_LT(MeanErrorOf_m(kByGyro, 0.0), kMost * at_once_m);
}

// The wheels slip aside by 0.12 m in each second, which neither they nor a gyro feel.
TEST(Deskew, InTightCirclesTheSlipOfTheWheelsIsTakenOut) {
  std::printf("circles of 0.2 m at 0.4 m/s\n");
  const double at_once_m = MeanErrorOf_m(kAtOnce, 0.4);
  const double skewed_m = MeanErrorOf_m(kSkewed, 0.4);
  EXPECT_LT(MeanErrorOf_m(kByWheels, 0.4), 0.2 * skewed_m);
  EXPECT_LT(MeanErrorOf_m(kByGyro, 0.4), kMostSlipping * at_once_m);
}

}  // namespace
}  // namespace qwsm::test
