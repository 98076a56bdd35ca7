// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "qwsm/logs/log_record.hpp"
#include "service/io/files/field_reader.hpp"

namespace qwsm::io {

/// One sweep as its line gives it, before what the line leaves open is filled in.
///
/// Open are a `range_max_m` of 0, the mounting unless `mounting_known`, the odometry if absent.
struct Sweep {
  ScanReading reading;
  std::string_view message;           ///< Name of the message, a literal such as "FLASER".
  bool mounting_known = false;        ///< Whether the log states the mounting apart from the line.
  std::optional<Pose2> T_odom_laser;  ///< Pose of the laser stated by the line, if it has one.
  bool odd_readings = false;          ///< Whether some readings are negative or not finite.
};

struct Comment {};
/// A message that is of no use here.
struct OtherMessage {};
struct UnknownMessage {
  std::string_view name;
};
struct MalformedLine {
  std::string_view message;  ///< Name of the message, a literal.
  FieldFault fault{};
};

/// What one line says.
using ParsedLine = std::variant<Comment,
                                OtherMessage,
                                UnknownMessage,
                                MalformedLine,
                                Sweep,
                                OdometryReading,
                                TruePoseReading,
                                ImuReading>;

/// Knows one text format, line by line.
class LogParser {
 public:
  LogParser() = default;
  LogParser(const LogParser&) = delete;
  LogParser& operator=(const LogParser&) = delete;
  virtual ~LogParser() = default;

  virtual std::string_view format() const = 0;
  /// Whether the format has time stamps; else the parser makes them up.
  virtual bool has_stamps() const { return true; }
  /// Parses a line; views in the result are valid as long as `line`.
  virtual ParsedLine Parse(std::string_view line) = 0;
};

/// The parser of the format that `line` is written in; null where it tells nothing, as comments do.
std::unique_ptr<LogParser> RecognizeFormat(std::string_view line,
                                           std::optional<double> field_of_view_rad);

}  // namespace qwsm::io
