// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/fuzz/input_file.hpp"

namespace qwsm::test {

/// Reads a bag: never a crash, never an exception but LogError, and only records that are sound and
/// in the order of their stamps.
inline void ReadBag(const InputFile& file, bool strict) {
  io::LogOptions options;
  options.strict = strict;
  try {
    const auto reader = io::OpenLog(file.path(), options);
    Timestamp last{};
    while (const std::optional<io::LogRecord> record = reader->Next()) {
      const auto* reading = std::get_if<io::ScanReading>(&*record);
      if (reading == nullptr) continue;
      Expect(ObjectionTo(reading->scan).empty());
      Expect(reading->scan.stamp >= last);
      Expect(!reading->T_odom_robot || IsFinite(*reading->T_odom_robot));
      last = reading->scan.stamp;
    }
    Expect(!strict || reader->report().faults.empty());
  } catch (const io::LogError& error) {
    Expect(!std::string(error.what()).empty());
  }
}

}  // namespace qwsm::test
