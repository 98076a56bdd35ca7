// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/network.hpp"

namespace qwsm::test {

/// A table of scans without how long their answers took.
inline std::string WithoutTimes(const std::string& table) {
  constexpr std::ptrdiff_t kTimes = 18;  // ms, cpu_ms.
  std::istringstream lines(table);
  std::string without;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (std::ssize(cells) < kTimes + 2) return table;
    cells.erase(cells.begin() + kTimes, cells.begin() + kTimes + 2);
    for (const std::string& cell : cells) without += cell + ',';
    without += '\n';
  }
  return without;
}

/// Expects of a service that was played a log what the mapper leaves of it, bit for bit: the poses
/// as they were answered, and path, loops, graph and map as they are corrected in the end.
/// @param served folder of the robot among the service's results. @param mapped the mapper's.
inline void ExpectSamePath(const std::filesystem::path& served,
                           const std::filesystem::path& mapped) {
  for (const char* file : {"trajectory_live.tum", "trajectory.tum", "trajectory.kitti"}) {
    const std::string expected = ReadFile(mapped / file);
    EXPECT_GT(expected.size(), 10'000U) << file;
    EXPECT_TRUE(ReadFile(served / file) == expected) << file;
  }
  EXPECT_EQ(WithoutTimes(ReadFile(served / "scans.csv")),
            WithoutTimes(ReadFile(mapped / "scans.csv")));
}
inline void ExpectSameMap(const std::filesystem::path& served,
                          const std::filesystem::path& mapped) {
  for (const char* file :
       {"loops.csv", "graph.g2o", "graph.toro", "map.pgm", "map.yaml", "map.png", "map_live.png"}) {
    const std::string expected = ReadFile(mapped / file);
    EXPECT_FALSE(expected.empty()) << file;
    EXPECT_TRUE(ReadFile(served / file) == expected) << file;
  }
}

/// Maps a log twice: played to a service over DDS as fast as it is answered, and read from its
/// file. Leaves the results in the folders `served` and `mapped`.
inline void MapOverNetworkAndFromFile(const PrivateNetwork& network,
                                      const std::filesystem::path& log,
                                      const std::filesystem::path& folder) {
  Daemon service(network.JoinService({"serve", "--output", folder / "served"}));
  const Outcome replay = network.Run({"replay", log, "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;

  const Outcome mapped = RunProgram({"map", log, "--output", folder / "mapped"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
}

}  // namespace qwsm::test
