// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Corrected poses are about as wrong as their covariances tell, in simulated offices.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/metrics/nees.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace qwsm::test {
namespace {

/// NEES of the corrected poses of a drive, seen from the first one.
double MeanNees(const sim::ScenarioOptions& scenario) {
  sim::Simulation simulation(scenario);
  SelfCorrectingMapper mapper;
  std::vector<Pose2> T_world_robot;
  while (const std::optional<sim::Reading> reading = simulation.Next()) {
    mapper.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    T_world_robot.push_back(reading->T_world_robot);
  }
  const Correction correction = mapper.Correct();
  const Pose2 T_map_world = correction.map_robot.front().T_a_b * T_world_robot.front().Inverse();
  std::vector<double> values;
  for (std::size_t i = 1; i < T_world_robot.size(); ++i) {
    const auto nees = Nees(correction.map_robot[i], T_map_world * T_world_robot[i]);
    if (nees) values.push_back(*nees);
  }
  return SummarizeNees(values).mean;
}

// One drive has one drift: three together tell more.
TEST(CorrectedCovariance, IsNeitherTooSmallNorFarTooLarge) {
  constexpr int kSeeds = 3;
  double sum = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    sum += MeanNees(sim::testing::Drive(sim::LayoutKind::kOffice, seed));
  }
  EXPECT_GT(sum / kSeeds, 0.7);
  EXPECT_LT(sum / kSeeds, 4.5);
}

}  // namespace
}  // namespace qwsm::test
