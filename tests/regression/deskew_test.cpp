// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that turns at 2 rad/s while its laser scans, ten times a second and all the time, beside
// one whose scans are taken at once. The errors are printed: docs/results.md tells of them.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <memory>
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
constexpr double kMostOfAtOnce = 1.2;  // Times the error of scans that are taken at once.
constexpr double kMostWithoutOdometry = 1.6;
constexpr int kDrivesInMotion = 5;

using Tell = std::function<Observation(const sim::Reading&)>;

/// A robot in an office, and how its scans are taken.
sim::ScenarioOptions Scanning(int seed, double sweep_s, bool has_gyro) {
  sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
  scenario.layout.office.persons = 0;  // They would bump into it.
  sim::RobotOptions& robot = scenario.robots[0];
  robot.gyro.enabled = has_gyro;
  robot.laser.useful_range_m = 30.0;
  robot.laser.beams = 361;
  robot.laser.field_of_view_rad = 2.0 * std::numbers::pi;
  robot.laser.sweep_s = sweep_s;
  return scenario;
}

/// It turns in a corridor for half a minute, on the spot or in circles.
sim::ScenarioOptions Turning(int seed, double sweep_s, bool has_gyro) {
  sim::ScenarioOptions scenario = Scanning(seed, sweep_s, has_gyro);
  scenario.duration_s = 30.0;
  scenario.robots[0].driver.kind = sim::DriverKind::kExternal;
  scenario.robots[0].start_x_m = 8.0;
  return scenario;
}

/// It drives through rooms for a minute.
sim::ScenarioOptions Driving(int seed, double sweep_s, bool has_gyro) {
  sim::ScenarioOptions scenario = Scanning(seed, sweep_s, has_gyro);
  scenario.duration_s = 60.0;
  return scenario;
}

double ErrorOf_m(sim::Simulation& simulation, const Tell& tell) {
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

/// A drive of that seed, its scans taken so.
using MakeDrive = std::function<std::unique_ptr<sim::Simulation>(int seed, const Way& way)>;

double MeanErrorOf_m(const Way& way, const MakeDrive& drive) {
  double sum_m = 0.0;
  std::printf("  %-34s", way.name);
  for (int seed = 1; seed <= kDrivesInMotion; ++seed) {
    const double error_m = ErrorOf_m(*drive(seed, way), way.tell);
    std::printf(" %5.2f", 1e3 * error_m);
    sum_m += error_m;
  }
  std::printf("  mean %5.2f mm\n", 1e3 * sum_m / kDrivesInMotion);
  return sum_m / kDrivesInMotion;
}

std::unique_ptr<sim::Simulation> Turn(int seed, const Way& way, double forward_mps) {
  auto drive = std::make_unique<sim::Simulation>(Turning(seed, way.sweep_s, way.has_gyro));
  drive->SetCommand(0, {.forward_mps = forward_mps, .turn_rad_s = kTurn_rad_s});
  return drive;
}
std::unique_ptr<sim::Simulation> OnTheSpot(int seed, const Way& way) {
  return Turn(seed, way, 0.0);
}
std::unique_ptr<sim::Simulation> Circling(int seed, const Way& way) { return Turn(seed, way, 0.4); }
std::unique_ptr<sim::Simulation> ThroughRooms(int seed, const Way& way) {
  return std::make_unique<sim::Simulation>(Driving(seed, way.sweep_s, way.has_gyro));
}

Observation AsMeasured(const sim::Reading& reading) {
  return {.scan = reading.scan, .T_odom_robot = reading.T_odom_robot, .gyro_rad = reading.gyro_rad};
}

Observation WithoutOdometry(const sim::Reading& reading) { return {.scan = reading.scan}; }

Observation WithoutTimes(const sim::Reading& reading) {
  Observation observation{.scan = reading.scan};
  observation.scan.sweep = {};
  return observation;
}

const Way kBlindAtOnce{"at once, without odometry", 0.0, false, WithoutOdometry};
const Way kBlindSkewed{"in 0.1 s, as measured", kSweep_s, false, WithoutTimes};
const Way kBlind{"in 0.1 s, by the matches", kSweep_s, false, WithoutOdometry};
const Way kAtOnce{"at once", 0.0, false, AsMeasured};
const Way kSkewed{"in 0.1 s, as measured", kSweep_s, false, AsMeasured};
const Way kByWheels{"in 0.1 s, from one place by wheels", kSweep_s, false, sim::ObservationOf};
const Way kByGyro{"and by the gyro", kSweep_s, true, sim::ObservationOf};

TEST(Deskew, OnTheSpotScansAreAsGoodAsThoseTakenAtOnce) {
  std::printf("turning on the spot\n");
  const double at_once_m = MeanErrorOf_m(kAtOnce, OnTheSpot);
  const double skewed_m = MeanErrorOf_m(kSkewed, OnTheSpot);
  EXPECT_GT(skewed_m, 2.0 * at_once_m) << "there is nothing to mend";
  EXPECT_LT(MeanErrorOf_m(kByWheels, OnTheSpot), kMostOfAtOnce * at_once_m);
  EXPECT_LT(MeanErrorOf_m(kByGyro, OnTheSpot), kMostOfAtOnce * at_once_m);
}

// The wheels slip aside by 0.12 m in each second, which neither they nor a gyro feel.
TEST(Deskew, InTightCirclesTheSlipOfTheWheelsIsTakenOut) {
  std::printf("circles of 0.2 m at 0.4 m/s\n");
  const double at_once_m = MeanErrorOf_m(kAtOnce, Circling);
  const double skewed_m = MeanErrorOf_m(kSkewed, Circling);
  EXPECT_GT(skewed_m, 5.0 * at_once_m) << "there is nothing to mend";
  EXPECT_LT(MeanErrorOf_m(kByWheels, Circling), kMostOfAtOnce * at_once_m);
  EXPECT_LT(MeanErrorOf_m(kByGyro, Circling), kMostOfAtOnce * at_once_m);
}

// Without odometry nothing but the matches tells how the robot moves.
TEST(Deskew, WithoutOdometryTheMatchesTellTheMotion) {
  std::printf("without odometry, a drive through an office\n");
  const double skewed_in_rooms_m = MeanErrorOf_m(kBlindSkewed, ThroughRooms);
  const double rooms_m = MeanErrorOf_m(kBlindAtOnce, ThroughRooms);
  EXPECT_GT(skewed_in_rooms_m, 5.0 * rooms_m) << "there is nothing to mend";
  EXPECT_LT(MeanErrorOf_m(kBlind, ThroughRooms), kMostWithoutOdometry * rooms_m);
  std::printf("without odometry, circles of 0.2 m at 0.4 m/s\n");
  const double skewed_m = MeanErrorOf_m(kBlindSkewed, Circling);
  const double circles_m = MeanErrorOf_m(kBlindAtOnce, Circling);
  EXPECT_GT(skewed_m, 5.0 * circles_m) << "there is nothing to mend";
  EXPECT_LT(MeanErrorOf_m(kBlind, Circling), kMostWithoutOdometry * circles_m);
}

}  // namespace
}  // namespace qwsm::test
