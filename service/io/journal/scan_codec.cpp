// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/scan_codec.hpp"

#include <cstdint>
#include <utility>

#include "qwsm/sensor/scan_limits.hpp"
#include "service/io/journal/pose_codec.hpp"

namespace qwsm::io {
namespace {

// What there is of a scan in a journal.
constexpr std::uint32_t kHasOdometry = 1;
constexpr std::uint32_t kHasComponent = 2;

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
  AddPose(writer, relevant.map_robot);
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
  relevant.map_robot = ReadUncertainPose(reader);
  relevant.scan.geometry = ReadGeometry(reader);
  const std::size_t beams = reader.Count(sizeof(float));
  relevant.scan.ranges_m.resize(beams);
  for (float& range_m : relevant.scan.ranges_m) range_m = reader.Float();
  const std::string_view objection = ObjectionTo(relevant.scan);
  if (!objection.empty()) throw BinaryError(std::string(objection));
  return relevant;
}

std::string EncodeScan(const JournaledScan& scan) {
  BinaryWriter writer;
  writer.Add((scan.T_odom_robot ? kHasOdometry : 0U) |
             (scan.component.empty() ? 0U : kHasComponent));
  if (!scan.component.empty()) writer.Add(std::string_view(scan.component));
  AddPose(writer, scan.T_odom_robot.value_or(Pose2{}));
  AddScan(writer, scan.relevant);
  return writer.bytes();
}

JournaledScan DecodeScan(std::string_view bytes) {
  BinaryReader reader(bytes);
  JournaledScan scan;
  const std::uint32_t has = reader.Unsigned32();
  if ((has & kHasComponent) != 0) scan.component = reader.Text();
  const Pose2 T_odom_robot = ReadPose(reader);
  if ((has & kHasOdometry) != 0) scan.T_odom_robot = T_odom_robot;
  scan.relevant = ReadScan(reader);
  if (reader.remaining() > 0) throw BinaryError("there is more in it than a scan");
  return scan;
}

}  // namespace qwsm::io
