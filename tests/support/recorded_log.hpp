// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/observation.hpp"

namespace qwsm::test {

/// The scans of a recorded log, with odometry.
inline std::vector<Observation> ObservationsOf(const std::filesystem::path& path) {
  std::vector<Observation> observations;
  const auto log = io::OpenLog(path);
  while (const auto record = log->Next()) {
    const auto* reading = std::get_if<io::ScanReading>(&*record);
    if (reading == nullptr) continue;
    observations.push_back({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
  }
  return observations;
}

}  // namespace qwsm::test
