// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/text_log_reader.hpp"

#include <algorithm>
#include <utility>

namespace qwsm::io {
namespace {

constexpr std::size_t kMaxLinesToRecognize = 10'000;
constexpr std::size_t kSweepsAhead = 1000;
constexpr std::size_t kReadingsAhead = 4'000'000;  // 16 MB.
constexpr std::size_t kMessagesAhead = 200'000;
constexpr std::size_t kMaxUnknownNames = 50;
constexpr std::size_t kMaxNameSize = 40;

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

TextLogReader::TextLogReader(std::istream& stream, std::string_view name, const LogOptions& options)
    : options_(options), lines_(ByteSource(stream)), completer_(options) {
  report_.name = name;
  report_.compression = lines_.source().compression();
  Recognize();
  TellOfBagOptions();
}

/// Tells of what was asked for and is heeded with bags alone.
void TextLogReader::TellOfBagOptions() const {
  std::string names;
  const auto add = [&names](bool is_given, const char* name) {
    if (is_given) names.append(names.empty() ? "" : ", ").append(name);
  };
  add(!options_.scan_topics.empty(), "log.scan");
  add(!options_.odometry_topic.empty(), "log.odometry");
  add(options_.sweep_s.has_value(), "log.sweep_s");
  add(options_.laser_height_m.has_value(), "log.laser_height_m");
  add(options_.stamp_offset_s != 0.0, "log.stamp_offset_s");
  if (names.empty() || !options_.on_fault) return;
  options_.on_fault(report_.name + ": left out, as it counts for bags only: " + names);
}

void TextLogReader::Own(std::unique_ptr<std::istream> stream,
                        std::optional<std::uint64_t> bytes_total) {
  owned_stream_ = std::move(stream);
  bytes_total_ = bytes_total;
}

LogProgress TextLogReader::progress() const {
  return {.bytes_read = lines_.source().bytes_read(), .bytes_total = bytes_total_};
}

void TextLogReader::Throw(const std::string& what) const {
  throw LogError(report_.name + ":" + what);
}

/// Reads up to the first line that only one format has.
void TextLogReader::Recognize() {
  try {
    while (parser_ == nullptr && report_.lines < kMaxLinesToRecognize) {
      const std::optional<Line> line = lines_.Next();
      if (!line) break;
      ++report_.lines;
      parser_ = RecognizeFormat(line->text, options_.field_of_view_rad);
      if (parser_ != nullptr) {
        report_.format = parser_->format();
        report_.has_stamps = parser_->has_stamps();
        return Take(parser_->Parse(line->text), line->number);
      }
      const std::string_view name = FieldReader(line->text).Word();
      if (!name.empty() && !name.starts_with('#')) CountUnknown(name);
    }
  } catch (const std::runtime_error& error) {
    Throw(" " + std::string(error.what()));
  }
  if (report_.lines == 0) Throw(" the file is empty");
  if (report_.name == kStandardInput) {
    Throw(
        " this is no text of CARMEN (FLASER, ODOM, ...), Player or DP-SLAM, which alone can be "
        "read from a pipe; name the file of a bag");
  }
  Throw(" this is no robot log: none of its first " + std::to_string(report_.lines) +
        " lines is a message of CARMEN (FLASER, ODOM, ...), Player or DP-SLAM, and it is no bag of "
        "ROS (.bag, .mcap, .db3 or a folder)");
}

std::optional<LogRecord> TextLogReader::Next() {
  while (true) {
    if (std::optional<LogRecord> record = filler_.Take()) {
      std::visit(Overloaded{[&](const ScanReading&) { ++report_.scans; },
                            [&](const OdometryReading&) { ++report_.odometry_readings; },
                            [&](const TruePoseReading&) { ++report_.true_poses; },
                            [&](const ImuReading&) { ++report_.imu_readings; }},
                 *record);
      return record;
    }
    if (!ended_) {
      ReadOn();
    } else if (failure_) {
      Throw(*std::exchange(failure_, std::nullopt));
    } else {
      return std::nullopt;
    }
  }
}

/// Reads one line, or ends the reading. Failures wait until what came before them is delivered.
void TextLogReader::ReadOn() {
  try {
    ReadLine();
  } catch (const std::runtime_error& error) {
    failure_ = std::string(error.what());
    ended_ = true;
  }
  if (!ended_) return;
  try {
    if (looking_ahead_) LookedAhead();
  } catch (const std::runtime_error& error) {
    if (!failure_) failure_ = " " + std::string(error.what());
  }
  filler_.Finish();
}

void TextLogReader::ReadLine() {
  std::optional<Line> line;
  try {
    line = lines_.Next();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(" " + std::string(error.what()));
  }
  ended_ = !line;
  if (!line) return;
  ++report_.lines;
  if (line->too_long) return TakeFault("line", FieldFault::kTooLong, line->number);
  Take(parser_->Parse(line->text), line->number);
}

void TextLogReader::Take(ParsedLine parsed, std::size_t line_number) {
  std::visit(Overloaded{[](Comment) {},
                        [&](OtherMessage) { ++report_.other_messages; },
                        [&](UnknownMessage unknown) { CountUnknown(unknown.name); },
                        [&](MalformedLine bad) { TakeFault(bad.message, bad.fault, line_number); },
                        [&](Sweep& sweep) {
                          if (sweep.odd_readings) {
                            TakeFault(sweep.message, FieldFault::kOddReadings, line_number);
                          }
                          Look(std::move(sweep));
                        },
                        [&](OdometryReading& reading) { Look(reading); },
                        [&](TruePoseReading& reading) { Look(reading); },
                        [&](ImuReading& reading) { Look(reading); }},
             parsed);
}

void TextLogReader::TakeFault(std::string_view message, FieldFault fault, std::size_t line_number) {
  const std::string what = std::string(message) + ": " + std::string(Explain(fault));
  if (options_.strict) throw std::runtime_error(std::to_string(line_number) + ": " + what);
  const auto known = std::ranges::find(report_.faults, what, &LogFault::what);
  if (known != report_.faults.end()) {
    ++known->count;
    return;
  }
  report_.faults.push_back({.what = what,
                            .count = 1,
                            .first_line = line_number,
                            .line_was_skipped = fault != FieldFault::kOddReadings});
  if (options_.on_fault) {
    options_.on_fault(report_.name + ":" + std::to_string(line_number) + ": " + what);
  }
}

void TextLogReader::CountUnknown(std::string_view name) {
  name = name.substr(0, kMaxNameSize);
  auto& unknown = report_.unknown_messages;
  const auto known = unknown.find(name);
  if (known != unknown.end()) {
    ++known->second;
  } else {
    ++unknown[unknown.size() < kMaxUnknownNames ? std::string(name) : "(others)"];
  }
}

/// Keeps the message until enough of the log was seen to know its lasers.
void TextLogReader::Look(Message message) {
  if (const auto* reading = std::get_if<OdometryReading>(&message)) {
    T_odom_robot_ = reading->T_odom_robot;
  }
  if (const auto* sweep = std::get_if<Sweep>(&message)) {
    completer_.Observe(*sweep, T_odom_robot_);
    ++sweeps_ahead_;
    readings_ahead_ += sweep->reading.scan.size();
  }
  if (!looking_ahead_) return Deliver(std::move(message));
  ahead_.push_back(std::move(message));
  if (sweeps_ahead_ >= kSweepsAhead || readings_ahead_ >= kReadingsAhead ||
      ahead_.size() >= kMessagesAhead) {
    LookedAhead();
  }
}

void TextLogReader::LookedAhead() {
  looking_ahead_ = false;
  completer_.Decide();
  for (Message& message : ahead_) Deliver(std::move(message));
  ahead_.clear();
}

void TextLogReader::Deliver(Message message) {
  std::visit(Overloaded{[&](Sweep& sweep) {
                          std::optional<ScanReading> scan = completer_.Complete(std::move(sweep));
                          if (scan) {
                            filler_.Push(std::move(*scan));
                          } else {
                            ++report_.other_scans;
                          }
                        },
                        [&](const OdometryReading& reading) { filler_.Push(reading); },
                        [&](const TruePoseReading& reading) { filler_.Push(reading); },
                        [&](const ImuReading& reading) { filler_.Push(reading); }},
             message);
}

}  // namespace qwsm::io
