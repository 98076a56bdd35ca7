// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/static_transforms.hpp"

#include <cstring>

#include "qwsm/geometry/position.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kMaxFrames = 10'000;  // Of any sane team; more is an attack.

bool IsName(const char* frame) { return strnlen(frame, kMaxNameLength + 1) <= kMaxNameLength; }

}  // namespace

template <class Kind>
void BasicStaticTransforms<Kind>::Take(const wire::TFMessage& message) {
  for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
    const wire::TransformStamped& transform = message.transforms._buffer[i];
    const auto& p = transform.transform.translation;
    const wire::Quaternion& rotation = transform.transform.rotation;
    const Pose T_parent_child = OnWire<Kind>::PoseOf({{p.x, p.y, p.z}, rotation});
    if (!IsName(transform.header.frame_id) || !IsName(transform.child_frame_id)) continue;
    if (!IsPosition(T_parent_child) || !OnWire<Kind>::IsRotation(rotation)) continue;
    if (links_.size() >= kMaxFrames && !links_.contains(transform.child_frame_id)) continue;
    links_[transform.child_frame_id] = {.parent = transform.header.frame_id,
                                        .T_parent_child = T_parent_child,
                                        .is_usable = OnWire<Kind>::IsUsable(rotation)};
  }
}

template <class Kind>
std::optional<typename Kind::Pose> BasicStaticTransforms<Kind>::Find(
    const std::string& ancestor, const std::string& frame) const {
  std::optional<Pose> T_current_frame;
  std::string current = frame;
  // A circle of frames ends after as many steps as there are frames.
  for (std::size_t step = 0; step <= links_.size(); ++step) {
    if (current == ancestor) return T_current_frame.value_or(Pose{});
    const auto link = links_.find(current);
    if (link == links_.end() || !link->second.is_usable) return std::nullopt;
    // One step is taken as it is: a product would round.
    const Pose& T_parent_current = link->second.T_parent_child;
    T_current_frame = T_current_frame ? T_parent_current * *T_current_frame : T_parent_current;
    current = link->second.parent;
  }
  return std::nullopt;
}

template class BasicStaticTransforms<team::Planar>;
template class BasicStaticTransforms<team::Spatial>;

}  // namespace qwsm::dds
