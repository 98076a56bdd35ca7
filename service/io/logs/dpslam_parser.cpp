// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/dpslam_parser.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {

bool DpslamParser::Recognizes(std::string_view line) {
  FieldReader fields(line);
  const std::string_view message = fields.Word();
  if (message == "Odometry") fields.Pose();
  if (message == "Laser") fields.Count(1);
  return (message == "Odometry" || message == "Laser") && !fields.fault();
}

ParsedLine DpslamParser::Parse(std::string_view line) {
  FieldReader fields(line);
  const std::string_view message = fields.Word();
  if (message.empty() || message.starts_with('#')) return Comment{};
  if (message == "Odometry") return ParseOdometry(fields);
  if (message == "Laser") return ParseLaser(fields);
  if (!IsPrintable(message)) return MalformedLine{"line", FieldFault::kNotText};
  return UnknownMessage{message};
}

Timestamp DpslamParser::Stamp() const {
  using std::chrono::milliseconds;
  return std::max<std::int64_t>(0, pairs_ - 1) * milliseconds(100);
}

ParsedLine DpslamParser::ParseOdometry(FieldReader fields) {
  const Pose2 T_odom_robot = fields.Pose();
  fields.ExpectEnd();
  if (fields.fault()) return MalformedLine{"Odometry", *fields.fault()};
  ++pairs_;
  T_odom_robot_ = T_odom_robot;
  return OdometryReading{.stamp = Stamp(), .T_odom_robot = T_odom_robot};
}

ParsedLine DpslamParser::ParseLaser(FieldReader fields) {
  Sweep sweep;
  sweep.message = "Laser";
  LaserScan& scan = sweep.reading.scan;
  scan.ranges_m = fields.Ranges(fields.Count(1));
  fields.ExpectEnd();
  if (fields.fault()) return MalformedLine{"Laser", *fields.fault()};
  if (!T_odom_robot_) ++pairs_;  // A sweep without odometry is a pair by itself.
  scan.stamp = Stamp();
  scan.geometry = GuessGeometry(scan.size(), field_of_view_rad_);
  sweep.reading.T_odom_robot = std::exchange(T_odom_robot_, std::nullopt);
  sweep.reading.laser = "front";
  sweep.odd_readings = fields.odd_readings();
  return sweep;
}

}  // namespace qwsm::io
