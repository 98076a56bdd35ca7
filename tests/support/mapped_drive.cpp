// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mapped_drive.hpp"

#include "qwsm/metrics/trajectory_error.hpp"

namespace qwsm::test {

MappedDrive::MappedDrive(const sim::ScenarioOptions& scenario, const MapperOptions& options)
    : simulation_(scenario), mapper_(options) {
  while (const std::optional<sim::Reading> reading = simulation_.Next()) {
    if (reading->robot != 0) continue;
    const MappingStep step =
        mapper_.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    if (step.status == StepStatus::kFirst)
      T_world_map_ = reading->T_world_robot * step.map_robot.T_a_b.Inverse();
    const Timestamp stamp = reading->scan.stamp;
    if (!poses_.empty() && poses_.back().stamp == stamp) poses_.pop_back();
    poses_.push_back({.stamp = stamp,
                      .T_map_true = T_world_map_.Inverse() * reading->T_world_robot,
                      .map_robot = step.map_robot});
  }
}

double AteRmse_m(std::span<const FoundPose> poses) {
  std::vector<PosePair> pairs;
  for (const FoundPose& pose : poses) {
    pairs.push_back(
        {.stamp = {}, .T_ref_robot = pose.T_map_true, .T_map_robot = pose.map_robot.T_a_b});
  }
  return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
}

}  // namespace qwsm::test
