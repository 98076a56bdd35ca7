// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/trajectory_sink.hpp"

#include "service/io/trajectories/trajectory_file.hpp"

namespace qwsm::pipeline {

void TrajectorySink::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  io::WriteTumLine(file_.stream(), {.stamp = step.stamp, .T_map_robot = step.map_robot.T_a_b});
  file_.ThrowIfFailed();
}

}  // namespace qwsm::pipeline
