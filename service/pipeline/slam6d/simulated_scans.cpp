// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/simulated_scans.hpp"

namespace slam6d::pipeline {
namespace {

Pose3 InSpace(const qwsm::Pose2& pose) {
  return {.rotation = RotationFromRollPitchYaw({0.0, 0.0, pose.theta_rad}),
          .translation_m = {pose.x_m, pose.y_m, 0.0}};
}

}  // namespace

SimulatedScans::SimulatedScans(const sim::ScenarioOptions& scenario,
                               const options::SimulationOptions& options)
    : options_(options),
      simulation_(scenario),
      world_(simulation_.scenery(), options.world),
      random_(sim::SeedFor("3D scans", static_cast<std::uint64_t>(scenario.seed))) {}

std::optional<SimulatedScan> SimulatedScans::Next() {
  while (const std::optional<sim::Reading> reading = simulation_.Next()) {
    if (reading->robot != 0) continue;
    const bool is_first = !T_world_last_;
    if (!is_first) {
      way_m_ += (reading->T_world_robot.translation_m() - T_world_last_->translation_m()).norm();
    }
    T_world_last_ = reading->T_world_robot;
    if (!is_first && way_m_ < options_.stop_every_m) continue;
    way_m_ = 0.0;
    const Pose3 T_robot_scanner{.translation_m = {0.0, 0.0, options_.laser.mount_height_m}};
    const Pose3 T_world_scan = world_.terrain().Stand(reading->T_world_robot) * T_robot_scanner;
    return SimulatedScan{.cloud = sim::Scan(world_, T_world_scan, options_.laser, random_),
                         .T_odom_scan = InSpace(reading->T_odom_robot),
                         .T_world_scan = T_world_scan};
  }
  return std::nullopt;
}

}  // namespace slam6d::pipeline
