// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/node_maker.hpp"

#include <utility>

namespace qwsm {

std::optional<ScanNode> NodeMaker::Take(const MappingStep& step) {
  odometry_ = odometry_ * step.odometry_motion;
  if (!step.relevant) return std::nullopt;
  ScanNode node{.scan = step.relevant_scan,
                .map_robot = step.map_robot,
                .odometry = std::exchange(odometry_, {}),
                .T_last_node = {}};
  if (map_last_ && !step.closed_loop) {
    node.T_last_node = map_last_->T_a_b.Inverse() * step.map_robot.T_a_b;
  }
  map_last_ = step.map_robot;
  return node;
}

}  // namespace qwsm
