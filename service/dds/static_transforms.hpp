// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>

#include "service/dds/planar.hpp"

namespace qwsm::dds {

/// What /tf_static says: where frames sit in their parent frames.
class StaticTransforms {
 public:
  /// Takes all that makes sense; transforms that do not are passed over.
  void Take(const wire::TFMessage& message);

  /// Where a frame sits on another, over any number of steps; nothing where that is not known, or
  /// not in the plane.
  std::optional<Pose2> Find(const std::string& ancestor, const std::string& frame) const;

 private:
  struct Link {
    std::string parent;
    Pose2 T_parent_child;
    bool is_upright = true;
  };

  std::map<std::string, Link> links_;  // By child.
};

}  // namespace qwsm::dds
