// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace qwsm::io {

/// The name of a log that comes from a pipe.
inline constexpr std::string_view kStandardInput = "standard input";

/// One kind of trouble with the lines of a log, however many lines have it.
struct LogFault {
  std::string what;            ///< Cause and remedy, as "FLASER: a field is not a number; ...".
  std::size_t count = 0;       ///< Lines that have this fault.
  std::size_t first_line = 0;  ///< First line that has this fault, counted from 1.
  /// Whether the line was skipped; else it was used, but for the faulty readings.
  bool line_was_skipped = true;
};

/// What was found in a log so far.
struct LogReport {
  std::string name;         ///< The file, or "standard input".
  std::string format;       ///< "CARMEN", "Player", "DP-SLAM", "journal", "ROS 1 bag",
                            ///< "rosbag2 (mcap)" or "rosbag2 (sqlite3)".
  std::string compression;  ///< "none", "gzip", "bzip2", "xz" or "zstd".
  bool has_stamps = true;   ///< False where the format has no stamps and they were made up.
  std::size_t lines = 0;
  std::string_view line_name = "lines";  ///< What is counted as such: lines, entries, messages.
  std::size_t scans = 0;                 ///< Scans delivered, like the next three counts.
  std::size_t odometry_readings = 0;
  std::size_t true_poses = 0;
  std::size_t imu_readings = 0;
  /// Scans not delivered: of lasers that were not asked for, or repeated sweeps.
  std::size_t other_scans = 0;
  /// Messages known, and of no use here: PARAM, SYNC, sonar, GPS, ...
  std::size_t other_messages = 0;
  /// Unknown messages, counted by name.
  std::map<std::string, std::size_t, std::less<>> unknown_messages;
  /// How it was understood where it leaves a choice, as "scans from /scan (laser on base_link)".
  std::vector<std::string> notes;
  std::vector<LogFault> faults;  ///< In the order of first sight.

  /// Number of lines that could not be used.
  std::size_t malformed_lines() const {
    std::size_t sum = 0;
    for (const LogFault& fault : faults) sum += fault.line_was_skipped ? fault.count : 0;
    return sum;
  }
};

}  // namespace qwsm::io
