// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Corrected paths of simulated robots, against the truth.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/nees.hpp"
#include "qwsm/metrics/trajectory_error.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

struct CorrectedDrive {
  std::vector<UncertainPose2> map_robot;
  std::vector<Pose2> T_map_true;  ///< Seen from the first pose.
};

CorrectedDrive Corrected(const sim::ScenarioOptions& scenario) {
  sim::Simulation simulation(scenario);
  SelfCorrectingMapper mapper;
  std::vector<Pose2> T_world_robot;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    mapper.Process(sim::ObservationOf(*reading));
    T_world_robot.push_back(reading->T_world_robot);
  }
  CorrectedDrive drive{.map_robot = mapper.Correct().map_robot, .T_map_true = {}};
  const Pose2 T_map_world = drive.map_robot.front().T_a_b * T_world_robot.front().Inverse();
  for (const Pose2& T_world : T_world_robot) drive.T_map_true.push_back(T_map_world * T_world);
  return drive;
}

double MeanNees(const CorrectedDrive& drive) {
  std::vector<double> values;
  for (std::size_t i = 1; i < drive.map_robot.size(); ++i) {
    if (const auto nees = Nees(drive.map_robot[i], drive.T_map_true[i])) values.push_back(*nees);
  }
  return SummarizeNees(values).mean;
}

double LastError_m(const CorrectedDrive& drive) {
  return (drive.map_robot.back().T_a_b.translation_m() - drive.T_map_true.back().translation_m())
      .norm();
}

// One drive has one drift: three together tell more.
TEST(CorrectedDrive, IsAsWrongAsItsCovariancesTell) {
  constexpr int kSeeds = 3;
  double sum = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sum += MeanNees(Corrected(sim::testing::Drive(sim::LayoutKind::kOffice, seed)));
  }
  EXPECT_GT(sum / kSeeds, 0.7);
  EXPECT_LT(sum / kSeeds, 4.5);
}

double TrajectoryError_m(const CorrectedDrive& drive) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < drive.map_robot.size(); ++i) {
    pairs.push_back({.T_ref_robot = drive.T_map_true[i], .T_map_robot = drive.map_robot[i].T_a_b});
  }
  return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
}

// On wet grass, where wheels turn further than the robot goes and matches of single trees do not
// tell by how much.
TEST(CorrectedDrive, IsHalfAsWrongWithAGyro) {
  double with_gyro_m = 0.0;
  double by_wheels_m = 0.0;
  for (int seed = 11; seed <= 16; ++seed) {
    sim::ScenarioOptions park = sim::testing::Park(seed);
    by_wheels_m += TrajectoryError_m(Corrected(park));
    park.robots.front().gyro.enabled = true;
    with_gyro_m += TrajectoryError_m(Corrected(park));
  }
  EXPECT_LT(with_gyro_m, 0.5 * by_wheels_m);
}

// Among these trees the robot turns twice with none in view, and comes back more than eight metres
// beside, as its covariance tells.
TEST(CorrectedDrive, IsRecognisedAsFarOffAsItMayBe) {
  EXPECT_LT(LastError_m(Corrected(sim::testing::Park(95))), 0.2);
}

}  // namespace
}  // namespace qwsm::test
