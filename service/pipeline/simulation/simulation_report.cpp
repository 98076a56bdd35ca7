// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/simulation_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {
namespace {

double SimulatedTime_s(const sim::Simulation& simulation) { return Seconds(simulation.now()); }

}  // namespace

std::string SimulationJson(const sim::Simulation& simulation, const SimulatedLogs& logs) {
  Json json;
  json["simulated_s"] = SimulatedTime_s(simulation);
  json["robots"] = Json::Array();
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const Pose2 error = logs[i]->OdometryError();
    Json robot;
    robot["name"] = simulation.robots()[i].options().name;
    robot["scans"] = logs[i]->scans();
    robot["path_length_m"] = logs[i]->path_length_m();
    robot["odometry_error_m"] = error.translation_m().norm();
    robot["odometry_error_deg"] = RadiansToDegrees(std::abs(error.theta_rad));
    robot["arrived"] = simulation.robots()[i].driver().has_arrived();
    json["robots"].Add(robot);
  }
  return json.Text();
}

std::string SimulationSummary(const sim::Simulation& simulation, const SimulatedLogs& logs) {
  std::string text = fmt::format("simulated      {:.0f} s\n", SimulatedTime_s(simulation));
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const Pose2 error = logs[i]->OdometryError();
    const sim::Robot& robot = simulation.robots()[i];
    text += fmt::format(
        "{:<14} {} scans, {:.1f} m; odometry is off by {:.2f} m and {:.1f} deg at the end{}\n",
        robot.options().name,
        logs[i]->scans(),
        logs[i]->path_length_m(),
        error.translation_m().norm(),
        RadiansToDegrees(std::abs(error.theta_rad)),
        robot.driver().has_arrived() ? "" : "; it did not arrive");
  }
  return text;
}

}  // namespace qwsm::pipeline
