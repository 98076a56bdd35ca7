// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/transform_tree.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm::io {
namespace {

// Fixed transforms are computed anew each time they are sent, with rounding.
constexpr double kMoved_m = 1e-4;
constexpr double kTurned = 1e-4;  // Of a quaternion's components.
constexpr std::size_t kMostFrames = 10'000;

bool IsSamePlace(const Transform3& a, const Transform3& b) {
  const double moved_m = std::hypot(a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m);
  const Quaternion& p = a.rotation;
  const Quaternion& q = b.rotation;
  const double cosine = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w;
  return moved_m < kMoved_m && 1.0 - std::abs(cosine) < kTurned * kTurned;
}

}  // namespace

std::string FrameName(std::string_view name) {
  return std::string(name.starts_with('/') ? name.substr(1) : name);
}

bool TransformTree::Take(const TransformMessage& transform,
                         bool is_static,
                         std::uint64_t sequence) {
  const std::string child = FrameName(transform.child_frame);
  if (!IsSound(transform.T_frame_child) || child.empty() || links_.size() >= kMostFrames) {
    return false;
  }
  const auto [known, is_new] = links_.try_emplace(child);
  Link& link = known->second;
  if (is_new) {
    link.parent = FrameName(transform.header.frame);
    link.T_parent_child = transform.T_frame_child;
  } else if (link.parent != FrameName(transform.header.frame)) {
    return false;
  }
  if (is_static) {
    link.T_parent_child = transform.T_frame_child;  // Of several, ROS takes the last.
    return true;
  }
  link.moves = link.moves || !IsSamePlace(link.T_parent_child, transform.T_frame_child);
  link.track.Add({.stamp = transform.header.stamp, .T_odom_robot = Planar(transform.T_frame_child)},
                 sequence);
  return true;
}

const TransformTree::Link* TransformTree::LinkOf(const std::string& child) const {
  const auto known = links_.find(child);
  return known == links_.end() ? nullptr : &known->second;
}

std::vector<std::string> TransformTree::AncestryOf(const std::string& frame) const {
  std::vector<std::string> frames{frame};
  // A circle of frames ends after as many steps as there are frames.
  while (frames.size() <= links_.size()) {
    const Link* link = LinkOf(frames.back());
    if (link == nullptr) break;
    frames.push_back(link->parent);
  }
  return frames;
}

std::optional<Transform3> TransformTree::FindUpwards(const std::string& ancestor,
                                                     const std::string& frame) const {
  std::optional<Transform3> T_current_frame;
  for (const std::string& current : AncestryOf(frame)) {
    if (current == ancestor) return T_current_frame.value_or(Transform3{});
    const Link* link = LinkOf(current);
    if (link == nullptr || link->moves) return std::nullopt;
    // One step is taken as it is: a product would round.
    const Transform3& T_parent_current = link->T_parent_child;
    T_current_frame = T_current_frame ? T_parent_current * *T_current_frame : T_parent_current;
  }
  return std::nullopt;
}

std::optional<Transform3> TransformTree::Find(const std::string& target,
                                              const std::string& frame) const {
  for (const std::string& common : AncestryOf(target)) {
    const std::optional<Transform3> T_common_frame = FindUpwards(common, frame);
    if (!T_common_frame) continue;
    if (common == target) return T_common_frame;
    const std::optional<Transform3> T_common_target = FindUpwards(common, target);
    if (!T_common_target) return std::nullopt;
    return T_common_target->Inverse() * *T_common_frame;
  }
  return std::nullopt;
}

std::optional<std::string> TransformTree::RobotFrameOf(const std::string& frame) const {
  const std::vector<std::string> ancestry = AncestryOf(frame);
  for (std::size_t i = 1; i < ancestry.size(); ++i) {
    if (ancestry[i].find("odom") != std::string::npos) return ancestry[i - 1];
  }
  for (const std::string& current : ancestry) {
    const Link* link = LinkOf(current);
    if (link != nullptr && link->moves) return current;
  }
  return std::nullopt;
}

}  // namespace qwsm::io
