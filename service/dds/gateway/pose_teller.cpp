// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/pose_teller.hpp"

#include <algorithm>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {

void PoseTeller::Prepare(const std::string& topic) {
  if (writers_.contains(topic)) return;
  writers_.try_emplace(topic, participant_, topic, Profile::kSensorOut);
}

void PoseTeller::Tell(const std::string& topic, const ToldPose& pose) {
  Prepare(topic);
  const auto& [x, y, z, qx, qy, qz, qw] = pose.position_orientation;
  wire::PoseWithCovarianceStamped sample{};
  sample.header = HeaderOf(pose.stamp, pose.frame);
  sample.pose.pose = {.position = {x, y, z}, .orientation = {qx, qy, qz, qw}};
  std::ranges::copy(pose.covariance, std::begin(sample.pose.covariance));
  writers_.at(topic).Write(sample);
}

}  // namespace qwsm::dds
