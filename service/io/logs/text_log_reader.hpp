// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/files/line_reader.hpp"
#include "service/io/logs/log_parser.hpp"
#include "service/io/logs/odometry_filler.hpp"
#include "service/io/logs/sweep_completer.hpp"

namespace qwsm::io {

/// Reads the line-oriented formats: lines -> parser -> look-ahead -> completion -> records.
class TextLogReader final : public LogReader {
 public:
  /// Reads until the format is recognised. The stream must outlive this unless it is owned.
  /// @throws LogError where it never is.
  TextLogReader(std::istream& stream, std::string_view name, const LogOptions& options);

  /// Keeps the stream alive, and knows how long it is.
  void Own(std::unique_ptr<std::istream> stream, std::optional<std::uint64_t> bytes_total);

  std::optional<LogRecord> Next() override;
  const LogReport& report() const override { return report_; }
  LogProgress progress() const override;

 private:
  using Message = std::variant<Sweep, OdometryReading, TruePoseReading, ImuReading>;

  void Recognize();
  void TellOfBagOptions() const;
  void ReadOn();
  void ReadLine();
  void Take(ParsedLine parsed, std::size_t line_number);
  void TakeFault(std::string_view message, FieldFault fault, std::size_t line_number);
  void CountUnknown(std::string_view name);
  void Look(Message message);
  void LookedAhead();
  void Deliver(Message message);
  [[noreturn]] void Throw(const std::string& what) const;

  std::unique_ptr<std::istream> owned_stream_;
  std::optional<std::uint64_t> bytes_total_;
  LogOptions options_;
  LogReport report_;
  LineReader lines_;
  std::unique_ptr<LogParser> parser_;
  SweepCompleter completer_;
  OdometryFiller filler_;
  std::deque<Message> ahead_;
  std::size_t sweeps_ahead_ = 0;
  std::size_t readings_ahead_ = 0;
  bool looking_ahead_ = true;
  bool ended_ = false;
  // Failure to be thrown when everything before it is delivered.
  std::optional<std::string> failure_;
  std::optional<Pose2> T_odom_robot_;  // The latest odometry.
};

}  // namespace qwsm::io
