// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A service that works for long without a new thing to learn keeps its memory: `ctest -C soak`.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "tests/support/process_state.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

/// How long; QWSM_SOAK_S for another time.
std::chrono::seconds Duration() {
  const char* text = std::getenv("QWSM_SOAK_S");
  return std::chrono::seconds(text == nullptr ? 600 : std::atoi(text));
}

struct Sample {
  double time_s = 0.0;
  double resident_kb = 0.0;
};

/// Slope of the line through the samples that has the least squares.
double KilobytesPerSecond(const std::vector<Sample>& samples) {
  double time_s = 0.0;
  double resident_kb = 0.0;
  for (const Sample& sample : samples) {
    time_s += sample.time_s / static_cast<double>(samples.size());
    resident_kb += sample.resident_kb / static_cast<double>(samples.size());
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (const Sample& sample : samples) {
    covariance += (sample.time_s - time_s) * (sample.resident_kb - resident_kb);
    variance += (sample.time_s - time_s) * (sample.time_s - time_s);
  }
  return covariance / variance;
}

TEST(DdsSoak, MemoryStaysFlat) {
  const TemporaryFolder folder;
  const PrivateNetwork network;
  RobotInRoom robot(network);
  // The map grows with relevant scans, as it must: here are none once the room is known.
  Daemon service(network.Join({"serve",
                               "--verbose",
                               "--journal",
                               folder.path() / "team.db",
                               "--set",
                               "mapper.relevant_translation_m=100",
                               "--set",
                               "mapper.relevant_rotation_deg=180",
                               "--set",
                               "team.map_period_s=1",
                               "--set",
                               "team.status_period_s=0.2"}));
  ASSERT_FALSE(robot.DriveUntilAnswered(300).empty());
  std::vector<Sample> samples;
  std::size_t reports = 0;
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begun < Duration()) {
    for (int i = 0; i < 20; ++i) reports += robot.Drive(25ms).size();
    robot.HealthOf("qwsm: service");
    robot.TakeSharedScans();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begun;
    if (time < Duration() / 6) continue;  // Buffers and caches fill.
    samples.push_back({time.count(), ResidentKilobytes(service.process())});
  }
  const std::string scans = robot.HealthOf("qwsm: service")["map_scans"];
  ASSERT_EQ(service.End().exit_code, 0);
  ASSERT_GT(samples.size(), 2U);
  const double growth_kb =
      KilobytesPerSecond(samples) * (samples.back().time_s - samples.front().time_s);
  std::cout << reports << " scans in " << Duration().count() << " s, " << scans
            << " of them relevant; memory " << samples.back().resident_kb << " kB, grown by "
            << growth_kb << " kB\n";
  EXPECT_GT(reports, 0U);
  EXPECT_LT(growth_kb, 0.02 * samples.back().resident_kb);
}

}  // namespace
}  // namespace qwsm::test
