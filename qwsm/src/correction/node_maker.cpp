// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/node_maker.hpp"

#include <utility>

namespace qwsm {

void NodeMaker::GoOn(const MappingStep& step) {
  since_.odometry = since_.odometry * step.odometry_motion;
  since_.adds_up = since_.adds_up && step.odometry_adds_up;
}

std::optional<ScanNode> NodeMaker::Take(const MappingStep& step) {
  const bool is_before = step.relevant && step.relevant_is_before;
  if (!is_before) GoOn(step);
  if (!step.relevant) return std::nullopt;
  const Motion motion = std::exchange(since_, {});
  if (is_before) GoOn(step);
  ScanNode node{.scan = step.relevant_scan,
                .map_robot = step.map_relevant,
                .odometry = motion.odometry,
                .T_last_node = {}};
  if (map_last_ && !step.closed_loop) {
    node.T_last_node = motion.adds_up ? motion.odometry.T_a_b
                                      : map_last_->T_a_b.Inverse() * step.map_relevant.T_a_b;
  }
  map_last_ = step.map_relevant;
  return node;
}

}  // namespace qwsm
