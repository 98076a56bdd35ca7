// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/scan_conversion.hpp"

#include <cstring>
#include <vector>

#include "qwsm/geometry/position.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/scans/component.hpp"
#include "service/team/scans/robot_name.hpp"

namespace qwsm::dds {
namespace {

std::size_t LengthOf(const char* name) { return strnlen(name, kMaxNameLength + 1); }

// Before the ranges are copied: an absurd count is to cost nothing.
std::string_view ObjectionTo(const dds_sequence_float& ranges) {
  if (ranges._length == 0) return "it has no ranges";
  if (ranges._length > kMostBeams) return "it has more than 100000 ranges";
  return {};
}

dds_sequence_float Borrow(const std::vector<float>& ranges_m) {
  const auto size = static_cast<std::uint32_t>(ranges_m.size());
  return {._maximum = size,
          ._length = size,
          ._buffer = const_cast<float*>(ranges_m.data()),
          ._release = false};
}

std::vector<float> Copy(const dds_sequence_float& ranges) {
  return {ranges._buffer, ranges._buffer + ranges._length};
}

double GapsOf(std::size_t beams) { return beams > 1 ? static_cast<double>(beams - 1) : 1.0; }

}  // namespace

wire::LaserScan ToWire(const LaserScan& scan, const std::string& frame) {
  const LaserGeometry& geometry = scan.geometry;
  wire::LaserScan sample{};
  sample.header = HeaderOf(scan.stamp, frame);
  sample.angle_min = geometry.first_bearing_rad;
  sample.angle_max = static_cast<float>(scan.size() > 0 ? geometry.Bearing(scan.size() - 1) : 0.0);
  sample.angle_increment = geometry.bearing_step_rad;
  sample.time_increment = static_cast<float>(Seconds(scan.sweep) / GapsOf(scan.size()));
  sample.range_min = geometry.range_min_m;
  sample.range_max = geometry.range_max_m;
  sample.ranges = Borrow(scan.ranges_m);
  return sample;
}

std::string_view ObjectionTo(const wire::LaserScan& sample) {
  const std::string_view objection = ObjectionTo(sample.header);
  return objection.empty() ? ObjectionTo(sample.ranges) : objection;
}

LaserScan FromWire(const wire::LaserScan& sample, const Pose2& T_robot_laser) {
  return {.stamp = *FromWire(sample.header.stamp),
          .geometry = {.first_bearing_rad = sample.angle_min,
                       .bearing_step_rad = sample.angle_increment,
                       .range_min_m = sample.range_min,
                       .range_max_m = RangeMaximumOf_m(sample.range_max),
                       .T_robot_laser = T_robot_laser},
          .ranges_m = Copy(sample.ranges),
          .sweep = StatedSweep(static_cast<double>(sample.time_increment) *
                               GapsOf(sample.ranges._length))};
}

wire::RelevantScan ToWire(const team::TeamScan& scan, const std::string& map_frame) {
  const LaserGeometry& geometry = scan.scan.geometry;
  wire::RelevantScan sample{};
  sample.header = HeaderOf(scan.scan.stamp, map_frame);
  sample.origin = Borrow(scan.key.service);
  sample.robot = Borrow(scan.key.robot);
  sample.sequence_number = scan.key.sequence;
  sample.pose = ToWire2D(scan.map_robot.T_a_b);
  CopyCovariance(scan.map_robot.covariance, sample.covariance);
  sample.has_odometry = scan.T_odom_robot.has_value();
  sample.odometry = ToWire2D(scan.T_odom_robot.value_or(Pose2{}));
  sample.laser = ToWire2D(geometry.T_robot_laser);
  sample.angle_min = geometry.first_bearing_rad;
  sample.angle_increment = geometry.bearing_step_rad;
  sample.range_min = geometry.range_min_m;
  sample.range_max = geometry.range_max_m;
  sample.ranges = Borrow(scan.scan.ranges_m);
  return sample;
}

std::string_view ObjectionTo(const wire::RelevantScan& sample) {
  if (const std::string_view objection = ObjectionTo(sample.header); !objection.empty()) {
    return objection;
  }
  if (LengthOf(sample.origin) == 0) return "it names no service";
  if (LengthOf(sample.origin) > kMaxNameLength || LengthOf(sample.robot) > kMaxNameLength) {
    return "a name in it is too long";
  }
  if (!team::IsRobotName(sample.robot)) return "its robot's name is no namespace";
  if (!team::IsRobotName(team::ComponentOf(sample.header.frame_id))) {
    return "its frame_id is no map's";
  }
  if (sample.has_odometry && !IsPosition(FromWire(sample.odometry))) {
    return "its odometry is no position";
  }
  return ObjectionTo(sample.ranges);
}

team::TeamScan FromWire(const wire::RelevantScan& sample) {
  team::TeamScan scan;
  scan.key = {.service = sample.origin, .robot = sample.robot, .sequence = sample.sequence_number};
  scan.component = team::ComponentOf(sample.header.frame_id);
  scan.scan = {.stamp = *FromWire(sample.header.stamp),
               .geometry = {.first_bearing_rad = sample.angle_min,
                            .bearing_step_rad = sample.angle_increment,
                            .range_min_m = sample.range_min,
                            .range_max_m = sample.range_max,
                            .T_robot_laser = FromWire(sample.laser)},
               .ranges_m = Copy(sample.ranges)};
  scan.map_robot = {.T_a_b = FromWire(sample.pose), .covariance = CovarianceOf(sample.covariance)};
  if (sample.has_odometry) scan.T_odom_robot = FromWire(sample.odometry);
  return scan;
}

}  // namespace qwsm::dds
