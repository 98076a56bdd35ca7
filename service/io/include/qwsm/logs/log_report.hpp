// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace qwsm::io {

/// One kind of trouble with the lines of a log, however many lines have it.
struct LogFault {
  std::string what;              ///< "FLASER: a field is not a number; ...": cause and remedy.
  std::size_t count = 0;         ///< Lines that have it.
  std::size_t first_line = 0;    ///< The first of them, counted from 1.
  bool line_was_skipped = true;  ///< Else the line was used, but for the faulty readings.
};

/// What was found in a log so far.
struct LogReport {
  std::string name;         ///< The file, or "standard input".
  std::string format;       ///< "CARMEN", "Player", "DP-SLAM" or "journal".
  std::string compression;  ///< "none", "gzip", "bzip2" or "xz".
  bool has_stamps = true;   ///< Else they were made up: the format has none.
  std::size_t lines = 0;
  std::size_t scans = 0;  ///< Delivered, like the next two.
  std::size_t odometry_readings = 0;
  std::size_t true_poses = 0;
  std::size_t other_scans = 0;     ///< Of lasers that were not asked for, and repeated sweeps.
  std::size_t other_messages = 0;  ///< Known, and of no use here: PARAM, SYNC, sonar, GPS, ...
  std::map<std::string, std::size_t, std::less<>> unknown_messages;  ///< By name.
  std::vector<LogFault> faults;  ///< In the order of first sight.

  /// Lines that could not be used.
  std::size_t malformed_lines() const {
    std::size_t sum = 0;
    for (const LogFault& fault : faults) sum += fault.line_was_skipped ? fault.count : 0;
    return sum;
  }
};

}  // namespace qwsm::io
