// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/cloud_codec.hpp"

#include <cstdint>

#include "service/io/files/binary.hpp"
#include "slam6d/geometry/position.hpp"

namespace slam6d::io {
namespace {

using qwsm::io::BinaryError;
using qwsm::io::BinaryReader;
using qwsm::io::BinaryWriter;

void AddPose(BinaryWriter& writer, const Pose3& pose) {
  for (const double entry : pose.rotation.reshaped()) writer.Add(entry);
  for (const double entry_m : pose.translation_m) writer.Add(entry_m);
}

Pose3 ReadPose(BinaryReader& reader) {
  Pose3 pose;
  for (double& entry : pose.rotation.reshaped()) entry = reader.Double();
  for (double& entry_m : pose.translation_m) entry_m = reader.Double();
  if (!IsPosition(pose)) throw BinaryError("a pose is not finite, or absurdly far away");
  return pose;
}

void AddOptionalPose(BinaryWriter& writer, const std::optional<Pose3>& pose) {
  writer.Add(static_cast<std::uint32_t>(pose.has_value() ? 1 : 0));
  AddPose(writer, pose.value_or(Pose3{}));
}

std::optional<Pose3> ReadOptionalPose(BinaryReader& reader) {
  const bool is_there = reader.Unsigned32() != 0;
  const Pose3 pose = ReadPose(reader);
  return is_there ? std::optional(pose) : std::nullopt;
}

}  // namespace

std::string EncodeCloud(const JournaledCloud& scan) {
  BinaryWriter writer;
  AddPose(writer, scan.T_robot_sensor);
  AddPose(writer, scan.T_odom_sensor);
  AddOptionalPose(writer, scan.T_odom_robot);
  AddOptionalPose(writer, scan.T_slam_odom);
  writer.Add(static_cast<std::uint64_t>(scan.cloud.size()));
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    for (const double coordinate_m : scan.cloud[i]) writer.Add(coordinate_m);
  }
  return writer.bytes();
}

JournaledCloud DecodeCloud(std::string_view bytes) {
  BinaryReader reader(bytes);
  JournaledCloud scan;
  scan.T_robot_sensor = ReadPose(reader);
  scan.T_odom_sensor = ReadPose(reader);
  scan.T_odom_robot = ReadOptionalPose(reader);
  scan.T_slam_odom = ReadOptionalPose(reader);
  scan.cloud = PointCloud(reader.Count(3 * sizeof(double)));
  for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
    Eigen::Vector3d point_m;
    for (double& coordinate_m : point_m) coordinate_m = reader.Double();
    scan.cloud.Set(i, point_m);
  }
  if (reader.remaining() > 0) throw BinaryError("there is more in it than a scan");
  return scan;
}

}  // namespace slam6d::io
