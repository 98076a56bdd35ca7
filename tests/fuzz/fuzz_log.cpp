// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using qwsm::test::Expect;
using namespace qwsm::io;

void ExpectSound(const ScanReading& reading) {
  const qwsm::LaserScan& scan = reading.scan;
  Expect(scan.size() >= 1 && scan.size() <= 100'000);
  Expect(scan.stamp.count() >= 0);
  Expect(std::isfinite(scan.geometry.Bearing(scan.size())));
  Expect(scan.geometry.range_max_m > 0.0F && !std::isnan(scan.geometry.range_max_m));
  Expect(IsFinite(scan.geometry.T_robot_laser));
  Expect(!reading.T_odom_robot || IsFinite(*reading.T_odom_robot));
}

/// All records up to the end or the first failure.
std::vector<LogRecord> ReadSome(const std::string& bytes, const LogOptions& options) {
  std::vector<LogRecord> records;
  try {
    std::istringstream stream(bytes);
    const auto reader = OpenLog(stream, "fuzz", options);
    while (const std::optional<LogRecord> record = reader->Next()) records.push_back(*record);
    const LogReport& report = reader->report();
    Expect(report.scans + report.odometry_readings + report.true_poses + report.imu_readings ==
           records.size());
    Expect(!options.strict || report.faults.empty());
  } catch (const LogError& error) {
    Expect(std::string(error.what()).starts_with("fuzz:"));
  }
  return records;
}

}  // namespace

/// Any bytes: never a crash, never an exception but LogError, only sound records; and what is
/// written of them reads back without a fault.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  LogOptions options;
  options.laser = "all";
  const std::vector<LogRecord> records = ReadSome(bytes, options);
  std::ostringstream written;
  CarmenWriter writer(written);
  for (const LogRecord& record : records) {
    if (const auto* scan = std::get_if<ScanReading>(&record)) ExpectSound(*scan);
    writer.Write(record);
  }
  std::istringstream copy(written.str());
  const auto reader = OpenLog(copy, "copy", options);
  while (reader->Next()) {
  }
  Expect(reader->report().malformed_lines() == 0);

  options.strict = true;
  options.laser.clear();
  Expect(ReadSome(bytes, options).size() <= records.size());
  return 0;
}
