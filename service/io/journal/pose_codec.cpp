// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/pose_codec.hpp"

#include <string>

#include "qwsm/geometry/position.hpp"

namespace qwsm::io {

void AddPose(BinaryWriter& writer, const Pose2& pose) {
  writer.Add(pose.x_m);
  writer.Add(pose.y_m);
  writer.Add(pose.theta_rad);
}

void AddPose(BinaryWriter& writer, const UncertainPose2& pose) {
  AddPose(writer, pose.T_a_b);
  // All nine, as rounding leaves them not quite symmetric.
  for (const double entry : pose.covariance.reshaped()) writer.Add(entry);
}

Pose2 ReadPose(BinaryReader& reader) {
  Pose2 pose;
  pose.x_m = reader.Double();
  pose.y_m = reader.Double();
  pose.theta_rad = reader.Double();
  if (!IsPosition(pose)) throw BinaryError("a pose is not finite, or absurdly far away");
  return pose;
}

UncertainPose2 ReadUncertainPose(BinaryReader& reader) {
  UncertainPose2 pose{.T_a_b = ReadPose(reader)};
  for (double& entry : pose.covariance.reshaped()) entry = reader.Double();
  const std::string_view objection = ObjectionTo(pose);
  if (!objection.empty()) throw BinaryError(std::string(objection));
  return pose;
}

}  // namespace qwsm::io
