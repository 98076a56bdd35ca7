// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/player_parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "qwsm/sensor/scan_limits.hpp"
#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {
namespace {

constexpr std::size_t kMaxDeviceIndex = 99;

constexpr std::array<std::string_view, 22> kOtherInterfaces{
    "sync",   "player",   "position3d", "gps",      "sonar",    "power",   "ptz", "wifi",
    "camera", "fiducial", "blobfinder", "imu",      "wsn",      "opaque",  "ir",  "bumper",
    "aio",    "dio",      "rfid",       "actarray", "localize", "joystick"};

bool IsInterface(std::string_view name) {
  return name == "laser" || name == "position" || name == "position2d" || name == "truth" ||
         std::ranges::find(kOtherInterfaces, name) != kOtherInterfaces.end();
}

std::optional<std::size_t> ParseIndex(std::string_view word) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  return whole && index <= kMaxDeviceIndex ? std::optional(index) : std::nullopt;
}

/// Whether the fourth field is a count: ranges are written with a decimal point.
bool HasCount(FieldReader fields) {
  fields.Skip(3);
  const std::string_view word = fields.Word();
  return !fields.fault() && !word.empty() && word.find('.') == std::string_view::npos;
}

/// False where the bearings are not evenly spaced, as those of a sweep are but for their rounding.
bool SetEvenBearings(LaserGeometry& geometry, std::span<const double> bearings_rad) {
  constexpr double kRounding_rad = 0.002;
  if (bearings_rad.empty()) return false;
  const double first_rad = bearings_rad.front();
  const double steps = std::max(1.0, static_cast<double>(bearings_rad.size()) - 1.0);
  const double step_rad = (bearings_rad.back() - first_rad) / steps;
  for (std::size_t i = 0; i < bearings_rad.size(); ++i) {
    const double even_rad = first_rad + static_cast<double>(i) * step_rad;
    if (!(std::abs(bearings_rad[i] - even_rad) < kRounding_rad)) return false;
  }
  geometry.first_bearing_rad = static_cast<float>(NormalizeAngle(first_rad));
  geometry.bearing_step_rad = static_cast<float>(step_rad);
  return std::abs(steps * step_rad) < 2.1 * std::numbers::pi;
}

}  // namespace

/// What stands before the data of a message.
struct PlayerParser::Header {
  Timestamp stamp{};
  std::string_view host;
  std::string_view robot;  ///< The port in 1.x.
  std::string_view interface;
  std::size_t index = 0;
  std::optional<std::size_t> type;  ///< Not in 1.x.
  std::size_t subtype = 0;

  bool IsData(std::size_t expected_subtype) const {
    return !type || (*type == 1 && subtype == expected_subtype);
  }
};

/// Nothing where the line does not begin like a message.
std::optional<PlayerParser::Header> PlayerParser::ReadHeader(FieldReader& fields) {
  Header header;
  std::optional<Timestamp> server_stamp = Timestamp{};
  header.interface = fields.Word();
  if (!IsInterface(header.interface)) {
    server_stamp = ParseStamp(header.interface);
    header.host = fields.Word();
    header.robot = fields.Word();
    header.interface = fields.Word();
  }
  const std::optional<std::size_t> index = ParseIndex(fields.Word());
  if (!server_stamp || !index) return std::nullopt;
  header.index = *index;
  const std::string_view type_or_stamp = fields.Word();
  if (!header.host.empty()) header.type = ParseIndex(type_or_stamp);
  if (header.type) {
    header.stamp = *server_stamp;
    const std::optional<std::size_t> subtype = ParseIndex(fields.Word());
    if (!subtype) return std::nullopt;
    header.subtype = *subtype;
  } else {
    const std::optional<Timestamp> sensor_stamp = ParseStamp(type_or_stamp);
    if (!sensor_stamp) return std::nullopt;
    header.stamp = *sensor_stamp == Timestamp{} ? *server_stamp : *sensor_stamp;
  }
  return header;
}

bool PlayerParser::Recognizes(std::string_view line) {
  if (line.starts_with("## Player version")) return true;
  FieldReader fields(line);
  const std::optional<Header> header = ReadHeader(fields);
  return header && IsInterface(header->interface);
}

ParsedLine PlayerParser::Parse(std::string_view line) {
  FieldReader fields(line);
  if (fields.AtEnd() || line.starts_with('#')) return Comment{};
  const std::optional<Header> header = ReadHeader(fields);
  if (!header) return MalformedLine{"line", FieldFault::kNoMessage};
  if (header->interface == "laser") {
    const bool is_mounting = header->type == 4U && header->subtype == 1;
    return is_mounting ? ParseMounting(*header, fields) : ParseLaser(*header, fields);
  }
  if (header->interface == "position" || header->interface == "position2d") {
    return ParsePosition(*header, fields);
  }
  if (header->interface == "truth") {
    TruePoseReading reading{
        .stamp = header->stamp, .T_world_robot = fields.Pose(), .T_odom_robot = {}};
    if (fields.fault()) return MalformedLine{"truth", *fields.fault()};
    return IsOtherRobot(*header) ? ParsedLine(OtherMessage{}) : ParsedLine(reading);
  }
  if (IsInterface(header->interface)) return OtherMessage{};
  return UnknownMessage{header->interface};
}

std::string PlayerParser::NameOf(const Header& header) {
  return std::string(header.host).append(":").append(header.robot);
}

/// Several robots may have written one log: the first one is followed.
bool PlayerParser::IsOtherRobot(const Header& header) {
  const std::string robot = NameOf(header);
  if (robot_.empty()) robot_ = robot;
  return robot != robot_;
}

/// `[scan_id] [px py pa] min_angle max_angle resolution [max_range] count (range intensity)...`:
/// the first and the fourth since 2.x, the pose with subtype 2 only.
ParsedLine PlayerParser::ParseLaser(const Header& header, FieldReader fields) {
  const bool posed = header.type && header.IsData(2);
  if (!posed && !header.IsData(1)) return OtherMessage{};
  if (!header.type && !HasCount(fields)) return ParseBeams(header, fields);
  Sweep sweep;
  LaserScan& scan = sweep.reading.scan;
  if (header.type) fields.Skip(1);
  if (posed) sweep.reading.T_odom_robot = fields.Pose();
  const double first_bearing_rad = fields.Number();
  const double last_bearing_rad = fields.Number();
  const double resolution_rad = fields.Number();
  const double range_max_m = header.type ? fields.Number() : 0.0;
  const std::size_t readings = fields.Count(1);
  scan.ranges_m = fields.Ranges(readings, 1);
  fields.ExpectEnd();
  if (fields.fault()) return MalformedLine{"laser", *fields.fault()};

  const std::optional<double> step_rad =
      BearingStep(last_bearing_rad - first_bearing_rad, resolution_rad, readings);
  if (!step_rad) return MalformedLine{"laser", FieldFault::kBadGeometry};
  scan.geometry.first_bearing_rad = static_cast<float>(NormalizeAngle(first_bearing_rad));
  scan.geometry.bearing_step_rad = static_cast<float>(*step_rad);
  scan.geometry.range_max_m = StatedRangeMaximum(range_max_m);
  sweep.odd_readings = fields.odd_readings();
  return Complete(header, std::move(sweep));
}

/// `(range bearing intensity)...`, as the first versions wrote.
ParsedLine PlayerParser::ParseBeams(const Header& header, FieldReader fields) {
  Sweep sweep;
  LaserScan& scan = sweep.reading.scan;
  std::vector<double> bearings_rad;
  while (!fields.AtEnd() && !fields.fault() && scan.size() < kMostBeams) {
    scan.ranges_m.push_back(fields.Range());
    bearings_rad.push_back(fields.Number());
    fields.Skip(1);
  }
  fields.ExpectEnd();
  if (fields.fault()) return MalformedLine{"laser", *fields.fault()};
  if (!SetEvenBearings(scan.geometry, bearings_rad)) {
    return MalformedLine{"laser", FieldFault::kBadGeometry};
  }
  sweep.odd_readings = fields.odd_readings();
  return Complete(header, std::move(sweep));
}

ParsedLine PlayerParser::Complete(const Header& header, Sweep sweep) {
  sweep.message = "laser";
  sweep.reading.laser = "laser:" + std::to_string(header.index);
  sweep.reading.scan.stamp = header.stamp;
  LaserGeometry& geometry = sweep.reading.scan.geometry;
  geometry.range_min_m = kNearestReading_m;
  if (IsOtherRobot(header)) {
    sweep.reading.laser.append("@").append(NameOf(header));
  } else if (const auto known = T_robot_laser_.find(header.index); known != T_robot_laser_.end()) {
    geometry.T_robot_laser = known->second;
    sweep.mounting_known = true;
  }
  return sweep;
}

ParsedLine PlayerParser::ParseMounting(const Header& header, FieldReader fields) {
  const Pose2 T_robot_laser = fields.Pose();
  if (!IsMounting(T_robot_laser)) fields.Fail(FieldFault::kTooFar);
  if (fields.fault()) return MalformedLine{"laser", *fields.fault()};
  if (!IsOtherRobot(header)) T_robot_laser_[header.index] = T_robot_laser;
  return OtherMessage{};
}

/// `px py pa vx vy va stall`. The first device is the wheels'; others, if any, are derived from it.
ParsedLine PlayerParser::ParsePosition(const Header& header, FieldReader fields) {
  if (!header.IsData(1) || IsOtherRobot(header)) return OtherMessage{};
  if (header.index > position_index_.value_or(header.index)) return OtherMessage{};
  position_index_ = header.index;
  OdometryReading reading{.stamp = header.stamp, .T_odom_robot = fields.Pose()};
  fields.Skip(3);
  if (fields.fault()) return MalformedLine{"position", *fields.fault()};
  return reading;
}

}  // namespace qwsm::io
