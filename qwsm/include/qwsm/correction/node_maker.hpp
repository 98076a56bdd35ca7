// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/correction/scan_node.hpp"
#include "qwsm/mapping/mapping_step.hpp"

namespace qwsm {

/// Makes nodes of the pose graph of the answers to the scans of one robot.
class NodeMaker {
 public:
  /// Takes the answer to the next scan. @return the node that it is if it is relevant.
  std::optional<ScanNode> Take(const MappingStep& step);

  /// The last node in the map as it is, if there is one.
  const std::optional<UncertainPose2>& map_last() const { return map_last_; }
  /// Follows a correction of the map. @param map_last of the last node, in the corrected map.
  void Follow(const UncertainPose2& map_last) { map_last_ = map_last; }

 private:
  struct Motion {
    UncertainPose2 odometry;
    bool adds_up = true;
  };

  void GoOn(const MappingStep& step);

  Motion since_;  // The last node.
  std::optional<UncertainPose2> map_last_;
};

}  // namespace qwsm
