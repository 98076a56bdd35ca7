// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Leaves the answers of a run as a bag of ROS 2, to be played beside that of the robot: /pose,
/// what /tf says of the odometry's frame in the map, and /map.
class AnswerBag final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  /// Replaces the poses by corrected ones. @pre as many as there were answers
  void Correct(std::span<const UncertainPose2> map_robot);

  /// Writes the bag. @param grid the map, where there is one. @throws io::WriteError
  void Write(const std::filesystem::path& path, const std::optional<OccupancyGrid>& grid) const;

 private:
  struct Answer {
    Timestamp stamp{};
    UncertainPose2 map_robot;
    std::optional<Pose2> T_odom_robot;
  };

  std::vector<Answer> answers_;
};

}  // namespace qwsm::pipeline
