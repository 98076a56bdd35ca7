// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/protocol/told_pose.hpp"

#include <chrono>

#include "service/dds/wire/robot_names.hpp"
#include "service/io/bags/messages/message_reader.hpp"

namespace qwsm::view {

dds::ToldPose DecodeToldPose(std::string_view cdr) {
  io::MessageReader reader(cdr, io::Encoding::kCdr);
  dds::ToldPose pose;
  const auto seconds = static_cast<std::int32_t>(reader.Unsigned32());
  pose.stamp =
      Timestamp(std::chrono::seconds(seconds) + std::chrono::nanoseconds(reader.Unsigned32()));
  pose.frame = reader.String();
  if (pose.frame.size() > dds::kMaxNameLength) throw io::MessageError("the frame has no name");
  for (double& value : pose.position_orientation) value = reader.Double();
  for (double& value : pose.covariance) value = reader.Double();
  return pose;
}

}  // namespace qwsm::view
