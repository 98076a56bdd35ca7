// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "service/options/slam6d/simulation_options.hpp"
#include "sim/simulation.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d::pipeline {

/// A 3D scan of a simulation.
struct SimulatedScan {
  PointCloud cloud;    ///< Points in the scanner's frame, in metres.
  Pose3 T_odom_scan;   ///< The scanner's pose in the plane, by the wheels.
  Pose3 T_world_scan;  ///< The true pose.
};

/// Robot 0 of a scenario drives, stops every now and then, and scans. The same options give the
/// same scans.
class SimulatedScans {
 public:
  /// Starts a simulation. @throws sim::ScenarioError.
  SimulatedScans(const sim::ScenarioOptions& scenario, const options::SimulationOptions& options);

  /// The next scan; nothing once the drive is over.
  std::optional<SimulatedScan> Next();

 private:
  options::SimulationOptions options_;
  sim::Simulation simulation_;
  sim::SolidWorld world_;
  sim::RandomEngine random_;
  std::optional<qwsm::Pose2> T_world_last_;  ///< The robot's pose at the last reading.
  double way_m_ = 0.0;                       ///< Way driven since the last scan.
};

}  // namespace slam6d::pipeline
