// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// 02_map_a_log LOG: replays a robot's log through the mapper, prints the trajectory in the TUM
// format, and says at the end how it went. The program `qwsm map` is this, with all its sinks.
#include <cstdlib>
#include <exception>
#include <iostream>

#include "qwsm/mapping/mapper.hpp"
#include "service/io/logs/log_reader.hpp"
#include "service/io/trajectories/trajectory_file.hpp"

namespace {

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
    qwsm::io::WriteTumLine(std::cout, {step.stamp, step.map_robot.T_a_b});
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
    MapLog(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
