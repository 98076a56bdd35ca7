// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {

/// The answers of a mapper on a drive, and where the robot was, in the frame of the map.
struct Answers {
  std::vector<MappingStep> steps;
  std::vector<Pose2> T_map_true;
};

inline Answers Drive(const Scene& scene, double range_max_m = 15.0) {
  const SimulatedDrive drive =
      DriveThrough(scene, {.laser = {.beams = 181, .range_max_m = range_max_m}});
  Answers answers;
  Mapper mapper;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    answers.steps.push_back(mapper.Process(drive.observations[i]));
    answers.T_map_true.push_back(drive.T_world_robot.front().Inverse() * drive.T_world_robot[i]);
  }
  return answers;
}

/// As if the map had drifted: each pose turns a little more than it should, and says so.
inline void Bend(std::vector<MappingStep>& steps, double turn_rad) {
  Pose2 T_bent;
  UncertainPose2 last;
  double sigma_rad = 0.0;
  for (MappingStep& step : steps) {
    const Pose2 moved = last.T_a_b.Inverse() * step.map_robot.T_a_b;
    last = step.map_robot;
    T_bent = T_bent * moved * Pose2{.theta_rad = turn_rad};
    sigma_rad += turn_rad;
    step.map_robot = UncertainPose2::WithSigmas(T_bent, 10.0 * sigma_rad, sigma_rad);
    step.map_relevant = step.map_robot;
  }
}

/// Of the steps that are relevant, each with the motion since the last one.
inline Answers Relevant(const Answers& all) {
  Answers relevant;
  UncertainPose2 last_robot;
  for (std::size_t i = 0; i < all.steps.size(); ++i) {
    last_robot = last_robot * all.steps[i].odometry_motion;
    if (!all.steps[i].relevant) continue;
    relevant.steps.push_back(all.steps[i]);
    relevant.steps.back().odometry_motion = std::exchange(last_robot, {});
    relevant.T_map_true.push_back(all.T_map_true[i]);
  }
  return relevant;
}

/// Once around offices and further, the map drifting by more than half a metre.
inline Answers BentOfficeLoop() {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  return Relevant(answers);
}

inline std::vector<UncertainPose2> PathOf(const std::vector<MappingStep>& steps) {
  std::vector<UncertainPose2> path;
  for (const MappingStep& step : steps) path.push_back(step.map_robot);
  return path;
}

inline double WorstError_m(const std::vector<UncertainPose2>& path,
                           const std::vector<Pose2>& truth) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    worst_m = std::max(worst_m, (path[i].T_a_b.translation_m() - truth[i].translation_m()).norm());
  }
  return worst_m;
}

}  // namespace qwsm::test
