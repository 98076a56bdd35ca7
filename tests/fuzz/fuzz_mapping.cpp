// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>

#include "qwsm/geometry/position.hpp"
#include "qwsm/logs/log_reader.hpp"
#include "qwsm/mapping/mapper.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using qwsm::test::Expect;
using namespace qwsm::io;

constexpr int kMostScans = 8;  // More of one input find nothing new, but take long.
constexpr std::size_t kMostBeams = 400;

}  // namespace

/// Any bytes as a log, and its first scans into a map: whatever a reader lets through, the mapper
/// can bear, and the robot is somewhere.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    std::istringstream stream(bytes);
    const auto reader = OpenLog(stream, "fuzz");
    qwsm::Mapper mapper;
    int scans = 0;
    while (const std::optional<LogRecord> record = reader->Next()) {
      const auto* reading = std::get_if<ScanReading>(&*record);
      if (reading == nullptr || reading->scan.size() > kMostBeams) continue;
      if (++scans > kMostScans) break;
      Expect(ObjectionTo(reading->scan).empty());
      const qwsm::MappingStep step =
          mapper.Process({.scan = reading->scan, .T_odom_robot = reading->T_odom_robot});
      Expect(IsPosition(step.map_robot.T_a_b) && step.map_robot.covariance.allFinite());
    }
  } catch (const LogError&) {
  }
  return 0;
}
