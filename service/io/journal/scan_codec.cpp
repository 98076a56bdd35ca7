// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/scan_codec.hpp"

#include <cstdint>
#include <utility>

#include "qwsm/geometry/position.hpp"
#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

void AddPose(BinaryWriter& writer, const Pose2& pose) {
  writer.Add(pose.x_m);
  writer.Add(pose.y_m);
  writer.Add(pose.theta_rad);
}

Pose2 ReadPose(BinaryReader& reader) {
  Pose2 pose;
  pose.x_m = reader.Double();
  pose.y_m = reader.Double();
  pose.theta_rad = reader.Double();
  if (!IsPosition(pose)) throw BinaryError("a pose is not finite, or absurdly far away");
  return pose;
}

LaserGeometry ReadGeometry(BinaryReader& reader) {
  LaserGeometry geometry;
  geometry.first_bearing_rad = reader.Float();
  geometry.bearing_step_rad = reader.Float();
  geometry.range_min_m = reader.Float();
  geometry.range_max_m = reader.Float();
  geometry.T_robot_laser = ReadPose(reader);
  return geometry;
}

}  // namespace

void AddScan(BinaryWriter& writer, const RelevantScan& relevant) {
  const LaserGeometry& geometry = relevant.scan.geometry;
  writer.Add(static_cast<std::int64_t>(relevant.scan.stamp.count()));
  AddPose(writer, relevant.map_robot.T_a_b);
  // All nine, as rounding leaves them not quite symmetric.
  for (const double entry : relevant.map_robot.covariance.reshaped()) writer.Add(entry);
  writer.Add(geometry.first_bearing_rad);
  writer.Add(geometry.bearing_step_rad);
  writer.Add(geometry.range_min_m);
  writer.Add(geometry.range_max_m);
  AddPose(writer, geometry.T_robot_laser);
  writer.Add(static_cast<std::uint64_t>(relevant.scan.size()));
  for (const float range_m : relevant.scan.ranges_m) writer.Add(range_m);
}

RelevantScan ReadScan(BinaryReader& reader) {
  RelevantScan relevant;
  relevant.scan.stamp = Timestamp(reader.Signed64());
  relevant.map_robot.T_a_b = ReadPose(reader);
  for (double& entry : relevant.map_robot.covariance.reshaped()) entry = reader.Double();
  relevant.scan.geometry = ReadGeometry(reader);
  const std::size_t beams = reader.Count(sizeof(float));
  relevant.scan.ranges_m.resize(beams);
  for (float& range_m : relevant.scan.ranges_m) range_m = reader.Float();
  for (const std::string_view objection :
       {ObjectionTo(relevant.scan), ObjectionTo(relevant.map_robot)}) {
    if (!objection.empty()) throw BinaryError(std::string(objection));
  }
  return relevant;
}

std::string EncodeScan(const JournaledScan& scan) {
  BinaryWriter writer;
  writer.Add(static_cast<std::uint32_t>(scan.T_odom_robot.has_value() ? 1 : 0));
  AddPose(writer, scan.T_odom_robot.value_or(Pose2{}));
  AddScan(writer, scan.relevant);
  return writer.bytes();
}

JournaledScan DecodeScan(std::string_view bytes) {
  BinaryReader reader(bytes);
  JournaledScan scan;
  const bool has_odometry = reader.Unsigned32() != 0;
  const Pose2 T_odom_robot = ReadPose(reader);
  if (has_odometry) scan.T_odom_robot = T_odom_robot;
  scan.relevant = ReadScan(reader);
  if (reader.remaining() > 0) throw BinaryError("there is more in it than a scan");
  return scan;
}

}  // namespace qwsm::io
