// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/io/bags/assembly/odometry_track.hpp"
#include "service/io/bags/messages/ros_messages.hpp"

namespace qwsm::io {

/// A frame's name without the slash that ROS 1 may put before it.
std::string FrameName(std::string_view name);

/// What /tf and /tf_static say of where frames sit in their parents.
///
/// ROS 1 repeats on /tf what never moves: here a frame is fixed unless it was seen to move.
class TransformTree {
 public:
  struct Link {
    std::string parent;
    Transform3 T_parent_child;  ///< As it was said first, or last on /tf_static.
    bool moves = false;
    OdometryTrack track;  ///< All that was said of it but by /tf_static.
  };

  /// Takes a transform that makes sense; others are passed over. @return whether it does.
  bool Take(const TransformMessage& transform, bool is_static, std::uint64_t sequence);

  bool empty() const { return links_.empty(); }
  /// The link to the parent; null where none was told.
  const Link* LinkOf(const std::string& child) const;
  /// The frames from `frame` to the root of its tree, itself first.
  std::vector<std::string> AncestryOf(const std::string& frame) const;
  /// Where a frame sits on another, if that never changes.
  std::optional<Transform3> Find(const std::string& target, const std::string& frame) const;
  /// The frame below `frame`'s odometry: the child of a frame named odom, or else the nearest
  /// ancestor that moves.
  std::optional<std::string> RobotFrameOf(const std::string& frame) const;

 private:
  std::optional<Transform3> FindUpwards(const std::string& ancestor,
                                        const std::string& frame) const;

  std::map<std::string, Link> links_;
};

}  // namespace qwsm::io
