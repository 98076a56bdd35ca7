// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "service/pipeline/simulation/reading_sink.hpp"
#include "service/pipeline/simulation/world_picture.hpp"

namespace qwsm::pipeline {

/// What one simulated robot leaves: a CARMEN log with the truth in it (TRUEPOS), and its true path
/// and its odometry as trajectories.
///
/// Both trajectories are poses in the world; odometry begins at the true pose.
class SimulatedLog final : public ReadingSink {
 public:
  /// Makes the files `NAME.log`, `NAME.truth.tum` and `NAME.odometry.tum` in the folder. Readings
  /// of other robots are passed over.
  SimulatedLog(const std::filesystem::path& folder, std::size_t robot, const std::string& name);

  void Take(const sim::Reading& reading) override;
  void Commit();

  const WorldPaths& paths() const { return paths_; }
  std::size_t scans() const { return paths_.truth.size(); }
  double path_length_m() const { return path_length_m_; }
  /// How far odometry ended from the truth.
  Pose2 OdometryError() const { return T_world_robot_.Inverse() * T_world_odometry_; }

 private:
  std::size_t robot_;
  io::AtomicFile log_;
  io::AtomicFile truth_;
  io::AtomicFile odometry_;
  io::CarmenWriter carmen_;
  WorldPaths paths_;
  double path_length_m_ = 0.0;
  std::optional<Pose2> T_world_odom_;
  Pose2 T_world_robot_;
  Pose2 T_world_odometry_;  ///< The robot's pose by its odometry.
};

}  // namespace qwsm::pipeline
