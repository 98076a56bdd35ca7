// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/json_lines_sink.hpp"

#include <cerrno>
#include <string>

#include "service/io/files/standard_output.hpp"
#include "service/pipeline/results/scan_table_sink.hpp"
#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {

void JsonLinesSink::Take(const TimedStep& timed) {
  if (!has_reader_) return;
  const MappingStep& step = timed.step;
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  Json json;
  json["stamp_s"] = Seconds(step.stamp);
  json["x_m"] = T_map_robot.x_m;
  json["y_m"] = T_map_robot.y_m;
  json["theta_rad"] = T_map_robot.theta_rad;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) json["covariance"].Add(step.map_robot.covariance(i, j));
  }
  json["status"] = Name(step.status);
  json["reason"] = step.reason;
  json["relevant"] = step.relevant;
  json["pairs"] = step.match.pairs;
  json["overlap"] = step.match.overlap;
  json["residual_mm"] = step.match.mean_residual_m * 1e3;
  json["trace"] = PositionTrace_m2(step.match);
  json["iterations"] = step.match.iterations;
  json["ms"] = std::chrono::duration<double, std::milli>(timed.duration).count();
  json["cpu_ms"] = std::chrono::duration<double, std::milli>(timed.worked).count();
  const std::string line = json.Line();
  const bool complete = std::fwrite(line.data(), 1, line.size(), stream_) == line.size();
  if (complete && std::fflush(stream_) == 0) return;
  has_reader_ = errno != EPIPE;
  if (has_reader_) throw io::StandardOutputError();
}

}  // namespace qwsm::pipeline
