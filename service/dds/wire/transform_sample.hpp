// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {

/// A message of transforms, to be written while the names of their frames live.
class TransformSample {
 public:
  TransformSample() = default;
  /// Makes a message of one transform, see Add().
  TransformSample(Timestamp stamp,
                  const std::string& parent,
                  const std::string& child,
                  const wire::Pose& pose) {
    Add(stamp, parent, child, pose);
  }
  TransformSample(const TransformSample&) = delete;
  TransformSample& operator=(const TransformSample&) = delete;

  /// Adds a transform. @param pose of the child in the parent.
  void Add(Timestamp stamp,
           const std::string& parent,
           const std::string& child,
           const wire::Pose& pose) {
    const auto& p = pose.position;
    transforms_.push_back({.header = HeaderOf(stamp, parent),
                           .child_frame_id = Borrow(child),
                           .transform = {{p.x, p.y, p.z}, pose.orientation}});
  }

  /// The message, which points into this object.
  wire::TFMessage sample() {
    const auto size = static_cast<std::uint32_t>(transforms_.size());
    return {
        .transforms = {
            ._maximum = size, ._length = size, ._buffer = transforms_.data(), ._release = false}};
  }

 private:
  std::vector<wire::TransformStamped> transforms_;
};

}  // namespace qwsm::dds
