// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// 02_map_a_log LOG: replays a robot's log through the mapper, prints the trajectory in the TUM
// format, and says at the end how it went. The program `qwsm map` is this, with all its sinks.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/mapper.hpp"

namespace {

/// A line `t x y z qx qy qz qw`, as evo and others read it.
void PrintPose(const qwsm::MappingStep& step) {
  const qwsm::Pose2& T_map_robot = step.map_robot.T_a_b;
  const double half_rad = 0.5 * T_map_robot.theta_rad;
  std::cout << std::chrono::duration<double>(step.stamp).count() << ' ' << T_map_robot.x_m << ' '
            << T_map_robot.y_m << " 0 0 0 " << std::sin(half_rad) << ' ' << std::cos(half_rad)
            << '\n';
}

void MapLog(const char* path) {
  const auto log = qwsm::io::OpenLog(path);
  qwsm::Mapper mapper;
  int scans = 0;
  int dead_reckoned = 0;
  while (const auto record = log->Next()) {
    const auto* reading = std::get_if<qwsm::io::ScanReading>(&*record);
    if (reading == nullptr) continue;  // Odometry alone, or a true pose: nothing to match.
    const qwsm::MappingStep step =
        mapper.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
    PrintPose(step);
    ++scans;
    if (step.status == qwsm::StepStatus::kDeadReckoned) ++dead_reckoned;
  }
  std::cerr << scans << " scans, " << dead_reckoned << " dead-reckoned, "
            << mapper.map().scans().size() << " in the map, "
            << mapper.map().surfaces().quadtree().size() << " points\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 02_map_a_log LOG\n";
    return 2;
  }
  try {
    std::cout << std::fixed << std::setprecision(6);
    MapLog(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
