// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that drives over thresholds: it leans forward and back, and its level laser sees the
// floor. Its inertial sensor tells which beams do.
#include "qwsm/sensor/floor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/metrics/trajectory_error.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr double kHeight_m = 0.3;
constexpr double kLean_rad = 0.07;  // 4 degrees: the floor is 4.3 m ahead.
constexpr double kBetween_s = 6.0;  // Between thresholds.
constexpr double kOverThreshold_s = 1.5;

/// Rotation about the axis to the left: positive where the robot's nose is down.
double PitchAt(double time_s) {
  const double phase_s = std::fmod(time_s, kBetween_s) - kBetween_s / 2.0;
  if (phase_s < 0.0 || phase_s > kOverThreshold_s) return 0.0;
  return kLean_rad * std::sin(2.0 * std::numbers::pi * phase_s / kOverThreshold_s);
}

/// A cheap sensor on a shaking robot, mounted half a degree off.
class ShakenImu {
 public:
  explicit ShakenImu(unsigned seed) : random_(seed) {}

  ImuReading Read(Timestamp stamp) {
    constexpr double kStep_s = 1e-3;
    const double time_s = Seconds(stamp);
    const double pitch_rad = PitchAt(time_s) + kMounting_rad;
    const double rate_rad_s = (PitchAt(time_s + kStep_s) - PitchAt(time_s)) / kStep_s;
    ImuReading reading{.stamp = stamp};
    reading.turn_rate_rad_s = Noise(0.005) + Eigen::Vector3d(0.0, rate_rad_s + 0.003, 0.0);
    reading.acceleration_mps2 =
        Eigen::Vector3d(-9.81 * std::sin(pitch_rad), 0.0, 9.81 * std::cos(pitch_rad)) + Noise(0.5);
    return reading;
  }

 private:
  static constexpr double kMounting_rad = 0.01;

  Eigen::Vector3d Noise(double sigma) {
    return sigma * Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_));
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/// Cuts the beams off where they meet the floor. @return which ones do.
std::vector<bool> MeetFloor(double pitch_rad, LaserScan& scan) {
  std::vector<bool> meets(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double sinks = std::sin(pitch_rad) *
                         std::cos(scan.geometry.T_robot_laser.theta_rad + scan.geometry.Bearing(i));
    if (sinks <= 0.0) continue;
    const double laser_above_m =
        kHeight_m * std::cos(pitch_rad) - scan.geometry.T_robot_laser.x_m * std::sin(pitch_rad);
    const auto floor_m = static_cast<float>(laser_above_m / sinks);
    if (scan.ranges_m[i] <= floor_m) continue;
    scan.ranges_m[i] = floor_m;
    meets[i] = StateOf(floor_m, scan.geometry) == BeamState::kHit;
  }
  return meets;
}

struct Counts {
  std::size_t of_floor = 0;
  std::size_t of_floor_kept = 0;
  std::size_t of_walls = 0;
  std::size_t of_walls_lost = 0;
  double level_m = 0.0;  // Errors of mapping.
  double leaning_m = 0.0;
  double mended_m = 0.0;
};

Counts DriveOverThresholds(int seed) {
  sim::ScenarioOptions scenario = sim::testing::Drive(sim::LayoutKind::kOffice, seed);
  scenario.duration_s = 90.0;
  scenario.layout.office.persons = 0;
  sim::Simulation simulation(scenario);
  ShakenImu imu(static_cast<unsigned>(seed));
  TiltTrack tilts;
  Timestamp felt{};
  Counts counts;
  std::array<Mapper, 3> mappers;
  std::array<std::vector<PosePair>, 3> pairs;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    const Timestamp stamp = reading->scan.stamp;
    for (; felt <= stamp; felt += 10ms) tilts.Add(imu.Read(felt));
    std::array<LaserScan, 3> scans{reading->scan, reading->scan, reading->scan};
    const std::vector<bool> meets = MeetFloor(PitchAt(Seconds(stamp)), scans[1]);
    scans[2] = scans[1];
    const std::optional<Tilt> tilt = tilts.At(stamp);
    if (tilt) LeaveOutFloor(*tilt, kHeight_m, scans[2]);
    for (std::size_t i = 0; i < meets.size(); ++i) {
      if (StateOf(scans[1].ranges_m[i], scans[1].geometry) != BeamState::kHit) continue;
      const bool is_kept = !std::isnan(scans[2].ranges_m[i]);
      counts.of_floor += meets[i];
      counts.of_floor_kept += meets[i] && is_kept;
      counts.of_walls += !meets[i];
      counts.of_walls_lost += !meets[i] && !is_kept;
    }
    for (std::size_t k = 0; k < mappers.size(); ++k) {
      const MappingStep step =
          mappers[k].Process({.scan = scans[k], .T_odom_robot = reading->T_odom_robot});
      pairs[k].push_back({.stamp = step.stamp,
                          .T_ref_robot = reading->T_world_robot,
                          .T_map_robot = step.map_robot.T_a_b});
    }
  }
  const auto error_m = [&](std::size_t k) {
    return AbsoluteTrajectoryError(pairs[k], AlignUmeyama(pairs[k])).rmse;
  };
  counts.level_m = error_m(0);
  counts.leaning_m = error_m(1);
  counts.mended_m = error_m(2);
  return counts;
}

TEST(Floor, SeenFromALeaningRobotIsLeftOut) {
  for (int seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Counts counts = DriveOverThresholds(seed);
    std::printf(
        "  floor %zu, kept %zu; walls %zu, lost %zu; error level %.1f, leaning %.1f, mended %.1f "
        "mm\n",
        counts.of_floor,
        counts.of_floor_kept,
        counts.of_walls,
        counts.of_walls_lost,
        1e3 * counts.level_m,
        1e3 * counts.leaning_m,
        1e3 * counts.mended_m);
    EXPECT_GT(counts.of_floor, 1000U) << "false walls";
    EXPECT_LT(counts.of_floor_kept, counts.of_floor / 20);
    EXPECT_LT(counts.of_walls_lost, counts.of_walls / 100);
    EXPECT_LT(counts.mended_m, counts.leaning_m);
  }
}

}  // namespace
}  // namespace qwsm::test
