// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/log_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

namespace qwsm::pipeline {
namespace {

// Scans and readings of one moment may be minutes apart in a log of text, but not more.
constexpr std::size_t kGyroReadingsKept = 65'536;
constexpr std::size_t kMostScansHeld = 16;

}  // namespace

LogSource::LogSource(const std::vector<std::filesystem::path>& logs, const io::LogOptions& options)
    : warn_(options.on_fault),
      mirrored_(options.mirrored),
      stamp_offset_s_(options.stamp_offset_s),
      readers_(io::OpenLogs(logs, options)),
      gyro_(kGyroReadingsKept) {}

std::optional<Observation> LogSource::Next() {
  std::optional<Observation> observation = ahead_ ? std::exchange(ahead_, std::nullopt) : Read();
  if (observation) ++scans_;
  imu_ = std::exchange(imu_read_, {});
  T_odom_end_ = T_odom_end_read_;
  return observation;
}

const Observation* LogSource::Peek() {
  if (!ahead_) ahead_ = Read();
  return ahead_ ? &*ahead_ : nullptr;
}

std::optional<Observation> LogSource::Read() {
  std::optional<io::ScanReading> reading = ReadScan();
  if (!reading) return std::nullopt;
  Observation observation{.scan = std::move(reading->scan), .T_odom_robot = reading->T_odom_robot};
  T_odom_end_read_ = reading->T_odom_end;
  observation.gyro_rad = gyro_.At(observation.scan.stamp);
  Check(observation);
  CheckStamps(observation);
  return observation;
}

// Where there is a gyro, a scan waits until readings up to its last beam are read.
std::optional<io::ScanReading> LogSource::ReadScan() {
  const auto must_read = [this] {
    if (held_.empty()) return true;
    return held_.size() < kMostScansHeld && !gyro_.empty() &&
           !gyro_.Covers(held_.front().scan.stamp + held_.front().scan.sweep);
  };
  try {
    while (!failure_ && must_read() && ReadRecord()) continue;
  } catch (const io::LogError&) {
    failure_ = std::current_exception();
  }
  if (held_.empty() && failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (held_.empty()) return std::nullopt;
  io::ScanReading first = std::move(held_.front());
  held_.pop_front();
  return first;
}

/// Reads one record. @return false at the end of the last log.
bool LogSource::ReadRecord() {
  if (current_ == readers_.size()) return false;
  std::optional<io::LogRecord> record = readers_[current_]->Next();
  if (!record) {
    ++current_;
  } else if (auto* reading = std::get_if<io::ScanReading>(&*record)) {
    CheckOrder(reading->scan.stamp);
    held_.push_back(std::move(*reading));
  } else if (const auto* pose = std::get_if<io::TruePoseReading>(&*record)) {
    truth_.push_back({.stamp = pose->stamp, .T_map_robot = pose->T_world_robot});
  } else if (const auto* imu = std::get_if<ImuReading>(&*record)) {
    if (gyro_.Add(*imu)) imu_read_.push_back(*imu);
  }
  return true;
}

/// Warns where a log begins before the one before it ended.
void LogSource::CheckOrder(Timestamp stamp) {
  constexpr std::chrono::seconds kLeastFall(1);
  const bool is_first = current_ != last_log_;
  if (is_first && last_stamp_ && *last_stamp_ - stamp > kLeastFall && warn_) {
    warn_(
        fmt::format("{}: begins {:.1f} s before {} ends: give parts of one recording in the order "
                    "they were recorded in, and map others one by one, with --continue",
                    readers_[current_]->report().name,
                    Seconds(*last_stamp_ - stamp),
                    readers_[last_log_]->report().name));
  }
  last_log_ = current_;
  last_stamp_ = stamp;
}

void LogSource::Check(const Observation& observation) {
  if (told_of_turns_) return;
  turns_.Add(observation.scan, observation.T_odom_robot);
  if (!turns_.turns_against_odometry()) return;
  told_of_turns_ = true;
  if (!warn_) return;
  warn_(
      fmt::format("{}: scans and odometry turn against each other: the laser is upside down or "
                  "counts its beams from the other side; --set log.mirrored={} mends it",
                  readers_.front()->report().name,
                  !mirrored_));
}

// In a bag odometry has stamps of its own; in a text it stands beside the scan.
void LogSource::CheckStamps(const Observation& observation) {
  const io::LogReport& report = readers_.front()->report();
  const bool is_bag = report.line_name == "messages";
  if (!is_bag || told_of_stamps_ || told_of_turns_ || !warn_) return;
  stamps_.Add(observation.scan, observation.T_odom_robot);
  if (!stamps_.offset_s()) return;
  told_of_stamps_ = true;
  const double offset_s = *stamps_.offset_s();
  warn_(
      fmt::format("{}: scans are {:.2f} s {} odometry, by how both turn; "
                  "--set log.stamp_offset_s={:.2f} mends it",
                  report.name,
                  std::abs(offset_s),
                  offset_s < 0.0 ? "ahead of" : "behind",
                  stamp_offset_s_ + offset_s));
}

SourceProgress LogSource::progress() const {
  SourceProgress progress{.scans = scans_};
  double bytes_read = 0.0;
  double bytes_total = 0.0;
  bool is_known = true;
  for (const auto& reader : readers_) {
    progress.dropped += reader->report().malformed_lines();
    const io::LogProgress log = reader->progress();
    bytes_read += static_cast<double>(log.bytes_read);
    bytes_total += static_cast<double>(log.bytes_total.value_or(0));
    is_known = is_known && log.bytes_total.has_value();
  }
  if (is_known && bytes_total > 0.0) progress.share = std::min(1.0, bytes_read / bytes_total);
  return progress;
}

std::vector<std::string> LogSource::Describe() const {
  std::vector<std::string> lines;
  for (const auto& reader : readers_) {
    const io::LogReport& report = reader->report();
    const std::string imu =
        report.imu_readings > 0 ? fmt::format(", {} of an imu", report.imu_readings) : "";
    lines.push_back(fmt::format("{}: {} log, {} scans, {} odometry readings{} in {} {}",
                                report.name,
                                report.format,
                                report.scans,
                                report.odometry_readings,
                                imu,
                                report.lines,
                                report.line_name));
    for (const std::string& note : report.notes) {
      lines.push_back(fmt::format("{}: {}", report.name, note));
    }
    for (const io::LogFault& fault : report.faults) {
      lines.push_back(fmt::format("{}:{}: {} ({} {}{})",
                                  report.name,
                                  fault.first_line,
                                  fault.what,
                                  fault.count,
                                  report.line_name,
                                  fault.line_was_skipped ? ", skipped" : ""));
    }
  }
  return lines;
}

}  // namespace qwsm::pipeline
