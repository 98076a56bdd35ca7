// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/run_history.hpp"

#include <chrono>
#include <limits>
#include <utility>

namespace qwsm::pipeline {

void RunHistory::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  path_.Add({.stamp = step.stamp, .map_robot = step.map_robot, .status = step.status});
  residuals_mm_.Add(HasMatch(step.status) ? step.match.mean_residual_m * 1e3
                                          : std::numeric_limits<double>::quiet_NaN());
  times_ms_.Add(std::chrono::duration<double, std::milli>(timed.worked).count());
  if (!timed.T_odom_robot) return;
  if (!T_map_odom_) T_map_odom_ = step.map_robot.T_a_b * timed.T_odom_robot->Inverse();
  odometry_.Add({.stamp = step.stamp, .T_map_robot = *T_map_odom_ * *timed.T_odom_robot});
}

io::MapOverlay RunHistory::Overlay() const& {
  return {.path = path_.elements(), .truth = {}, .odometry = odometry_.elements()};
}

io::MapOverlay RunHistory::Overlay() && {
  return {.path = std::move(path_).elements(),
          .truth = {},
          .odometry = std::move(odometry_).elements()};
}

}  // namespace qwsm::pipeline
