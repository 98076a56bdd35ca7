// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Odometry that jumps: a counter overflows, a driver is started anew, somebody pushes the robot.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/mapping/mapper.hpp"
#include "qwsm/metrics/relations.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "tests/support/recorded_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

// From each of these scans on the robot seems to have been turned, and moved in its own frame.
std::vector<Observation> WithJumps(std::vector<Observation> observations,
                                   unsigned seed,
                                   const Pose2& jump = {.x_m = 2.0, .theta_rad = 1.2}) {
  constexpr std::size_t kJumps = 20;
  std::mt19937 random(seed);
  std::set<std::size_t> jumps;
  while (jumps.size() < kJumps) jumps.insert(1 + random() % (observations.size() - 1));
  Pose2 T_new_odom;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    Pose2& T_odom_robot = *observations[i].T_odom_robot;
    if (jumps.contains(i)) T_new_odom = T_new_odom * T_odom_robot * jump * T_odom_robot.Inverse();
    T_odom_robot = T_new_odom * T_odom_robot;
  }
  return observations;
}

double MeanErrorCorrected_m(const std::vector<Observation>& observations,
                            std::span<const Relation> relations) {
  SelfCorrectingMapper mapper;
  for (const Observation& observation : observations) mapper.Process(observation);
  const std::vector<UncertainPose2> map_robot = mapper.Correct().map_robot;
  Trajectory trajectory;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    trajectory.push_back({.stamp = observations[i].scan.stamp, .T_map_robot = map_robot[i].T_a_b});
  }
  return EvaluateRelations(relations, trajectory).all.translation_m.mean;
}

double MeanError_m(const std::vector<Observation>& observations,
                   std::span<const Relation> relations) {
  Mapper mapper;
  Trajectory trajectory;
  for (const Observation& observation : observations) {
    const MappingStep step = mapper.Process(observation);
    trajectory.push_back({.stamp = step.stamp, .T_map_robot = step.map_robot.T_a_b});
  }
  return EvaluateRelations(relations, trajectory).all.translation_m.mean;
}

TEST(JumpingOdometry, LeavesTheMapAsItWouldHaveBeen) {
  const fs::path data = fs::path(QWSM_DATA_DIR) / "radish";
  const fs::path log = data / "intel.full.clf.gz";
  if (!fs::exists(log)) GTEST_SKIP() << "no " << log;
  const std::vector<Relation> relations = io::ReadRelationsFile(data / "intel.full.relations");
  const std::vector<Observation> unbroken = ObservationsOf(log);
  const double error_m = MeanError_m(unbroken, relations);
  for (const unsigned seed : {1U, 2U}) {
    EXPECT_LT(MeanError_m(WithJumps(unbroken, seed), relations), 1.3 * error_m) << seed;
  }
  const Pose2 far_off{.x_m = 40.0, .theta_rad = 1.2};  // As to where odometry began: nothing fits.
  EXPECT_LT(MeanError_m(WithJumps(unbroken, 1, far_off), relations), 1.3 * error_m);
  EXPECT_LT(MeanErrorCorrected_m(WithJumps(unbroken, 3), relations),
            1.05 * MeanErrorCorrected_m(unbroken, relations));
}

}  // namespace
}  // namespace qwsm::test
