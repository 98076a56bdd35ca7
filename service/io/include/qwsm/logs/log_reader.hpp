// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/logs/log_record.hpp"
#include "qwsm/logs/log_report.hpp"

namespace qwsm::io {

/// Tells that a log cannot be opened, recognised or read on; or, when strict, its first malformed
/// line. The text begins with "file:" or "file:line:" and says what is wrong and how to mend it.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Tells that a bag holds several robots, and which, where it was not said whose scans are meant.
class SeveralRobotsError : public LogError {
 public:
  /// Names the robots. @param robots their namespaces, without slashes, as LogOptions::robot has
  /// them; those with the most scans first.
  SeveralRobotsError(const std::string& what, std::vector<std::string> robots)
      : LogError(what), robots_(std::move(robots)) {}

  const std::vector<std::string>& robots() const { return robots_; }

 private:
  std::vector<std::string> robots_;
};

/// How a log is read. What the log states and what can be inferred from it needs no option.
struct LogOptions {
  bool strict = false;  ///< Throw at a malformed line instead of counting and skipping it.
  /// The laser's name or message ("rear", "RLASER"), or "all"; empty: all of which it is known
  /// where they sit, or else the front one.
  std::string laser;
  /// Of a bag: topics of scans; empty: those of all lasers.
  std::vector<std::string> scan_topics;
  /// Of a bag: topic of odometry, or "/tf"; empty: the robot's own.
  std::string odometry_topic;
  /// Of a bag of several robots: the namespace of one. An only robot is read where it has none, or
  /// this is empty.
  std::string robot;
  /// Of a bag: time from a scan's first beam to its last, in seconds; else as its messages say.
  std::optional<double> sweep_s;
  /// Of a bag: whether scans taken in motion stay as they were measured, for who brings their beams
  /// to one place by himself: with their `sweep`, and ScanReading::T_odom_end.
  bool as_measured = false;
  /// Of a bag: height of the laser above the floor; else as its transforms say.
  std::optional<double> laser_height_m{};
  /// Of a bag: what is added to the stamps of scans, in seconds.
  double stamp_offset_s = 0.0;
  std::optional<Pose2> T_robot_laser;       ///< Replaces what the log says of the mounting.
  std::optional<float> range_max_m;         ///< Replaces what the log says or shows.
  std::optional<double> field_of_view_rad;  ///< Replaces the guess where lines do not state it.
  /// The laser is upside down, which nothing tells, or counts its beams from the other side.
  bool mirrored = false;
  /// Is called with each kind of fault once, as it appears.
  std::function<void(const std::string&)> on_fault;
};

/// How much of a log has been read.
struct LogProgress {
  std::uint64_t bytes_read = 0;              ///< Bytes of the file as it is, compressed or not.
  std::optional<std::uint64_t> bytes_total;  ///< Size of the file; unknown for a pipe.
};

/// Reads a robot log message by message.
///
/// Memory is bounded: the reader of a text looks some thousand sweeps ahead, to know the lasers
/// before it delivers the first, but never keeps the whole file; that of a bag keeps odometry and
/// transforms, and where the scans stand. What it delivers depends on nothing but the bytes: a pipe
/// gives the same records as a file.
class LogReader {
 public:
  LogReader() = default;
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;
  virtual ~LogReader() = default;

  /// The next message, in the order of the file, or that of the stamps in a bag; nothing at the
  /// end.
  /// @throws LogError where the file is damaged, after everything before the damage was delivered;
  ///         or, when strict, at a malformed line.
  virtual std::optional<LogRecord> Next() = 0;

  virtual const LogReport& report() const = 0;
  virtual LogProgress progress() const = 0;
};

/// Opens a log: CARMEN, Player or DP-SLAM text; plain, gzip, bzip2, xz or zstd; a bag of ROS 1, or
/// of rosbag2 as a file (.mcap, .db3) or a folder; or the journal of a service. All are recognised
/// from the content, never from the name. "-" is standard input, for texts.
/// @throws LogError where there is no such file or it is not a log; SeveralRobotsError where it is
///         a bag of several robots and the options name none.
std::unique_ptr<LogReader> OpenLog(const std::filesystem::path& path,
                                   const LogOptions& options = {});

/// Opens logs that are parts of one recording. Bags that follow each other are read as one: what
/// is said once, as where a laser sits, is in the first alone. @throws LogError as OpenLog() does.
std::vector<std::unique_ptr<LogReader>> OpenLogs(std::span<const std::filesystem::path> paths,
                                                 const LogOptions& options = {});

/// Opens a log of any of OpenLog's formats of text from a stream, which must outlive the reader;
/// `name` stands for it in messages.
std::unique_ptr<LogReader> OpenLog(std::istream& stream,
                                   std::string_view name,
                                   const LogOptions& options = {});

}  // namespace qwsm::io
