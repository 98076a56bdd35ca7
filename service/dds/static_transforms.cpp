// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/static_transforms.hpp"

#include <cmath>

namespace qwsm::dds {
namespace {

constexpr std::size_t kMaxFrames = 10'000;  // Of any sane team; more is an attack.
constexpr double kUpright = 0.999;          // Less than 2.6 degrees of tilt.

}  // namespace

void StaticTransforms::Take(const wire::TFMessage& message) {
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    const wire::TransformStamped& transform = message.transforms._buffer[i];
    const auto& p = transform.transform.translation;
    const wire::Quaternion& rotation = transform.transform.rotation;
    const Pose2 T_parent_child{p.x, p.y, YawOf(rotation)};
    const double uprightness = UprightnessOf(rotation);
    if (!IsFinite(T_parent_child) || !std::isfinite(uprightness)) continue;
    if (links_.size() >= kMaxFrames && !links_.contains(transform.child_frame_id)) continue;
    links_[transform.child_frame_id] = {.parent = transform.header.frame_id,
                                        .T_parent_child = T_parent_child,
                                        .is_upright = uprightness > kUpright};
  }
}

std::optional<Pose2> StaticTransforms::Find(const std::string& ancestor,
                                            const std::string& frame) const {
  std::optional<Pose2> T_current_frame;
  std::string current = frame;
  // A circle of frames ends after as many steps as there are frames.
  for (std::size_t step = 0; step <= links_.size(); ++step) {
    if (current == ancestor) return T_current_frame.value_or(Pose2{});
    const auto link = links_.find(current);
    if (link == links_.end() || !link->second.is_upright) return std::nullopt;
    // One step is taken as it is: a product would round.
    const Pose2& T_parent_current = link->second.T_parent_child;
    T_current_frame = T_current_frame ? T_parent_current * *T_current_frame : T_parent_current;
    current = link->second.parent;
  }
  return std::nullopt;
}

}  // namespace qwsm::dds
