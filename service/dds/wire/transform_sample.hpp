// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {

/// A message of one transform, to be written while the names of its frames live.
class TransformSample {
 public:
  /// Makes the message. @param pose of the child in the parent.
  TransformSample(Timestamp stamp,
                  const std::string& parent,
                  const std::string& child,
                  const wire::Pose& pose) {
    transform_.header = HeaderOf(stamp, parent);
    transform_.child_frame_id = Borrow(child);
    transform_.transform.translation = {pose.position.x, pose.position.y, pose.position.z};
    transform_.transform.rotation = pose.orientation;
    message_.transforms = {._maximum = 1, ._length = 1, ._buffer = &transform_, ._release = false};
  }
  TransformSample(const TransformSample&) = delete;
  TransformSample& operator=(const TransformSample&) = delete;

  const wire::TFMessage& sample() const { return message_; }

 private:
  wire::TransformStamped transform_{};
  wire::TFMessage message_{};
};

}  // namespace qwsm::dds
