// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/simulated_log.hpp"

#include "service/io/trajectories/trajectory_file.hpp"

namespace qwsm::pipeline {
namespace {

/// The names that logs have for lasers.
std::string LaserName(std::size_t laser) {
  return laser == 0 ? "front" : laser == 1 ? "rear" : "laser" + std::to_string(laser + 1);
}

}  // namespace

SimulatedLog::SimulatedLog(const std::filesystem::path& folder,
                           std::size_t robot,
                           const std::string& name)
    : robot_(robot),
      log_(folder / (name + ".log")),
      truth_(folder / (name + ".truth.tum")),
      odometry_(folder / (name + ".odometry.tum")),
      carmen_(log_.stream()) {}

void SimulatedLog::Take(const sim::Reading& reading) {
  if (reading.robot != robot_) return;
  const Timestamp stamp = reading.scan.stamp;
  if (!T_world_odom_) {
    T_world_odom_ = reading.T_world_robot * reading.T_odom_robot.Inverse();
    T_world_robot_ = reading.T_world_robot;
  }
  path_length_m_ += (T_world_robot_.Inverse() * reading.T_world_robot).translation_m().norm();
  T_world_robot_ = reading.T_world_robot;
  T_world_odometry_ = *T_world_odom_ * reading.T_odom_robot;
  paths_.truth.push_back({.stamp = stamp, .T_map_robot = T_world_robot_});
  paths_.odometry.push_back({.stamp = stamp, .T_map_robot = T_world_odometry_});

  carmen_.Write(io::TruePoseReading{stamp, reading.T_world_robot, reading.T_odom_robot});
  for (const ImuReading& imu : reading.imu) carmen_.Write(imu);
  carmen_.Write(io::ScanReading{reading.scan, reading.T_odom_robot, LaserName(reading.laser)});
  io::WriteTumLine(truth_.stream(), paths_.truth.back());
  io::WriteTumLine(odometry_.stream(), paths_.odometry.back());
  log_.ThrowIfFailed();
}

void SimulatedLog::Commit() {
  log_.Commit();
  truth_.Commit();
  odometry_.Commit();
}

}  // namespace qwsm::pipeline
