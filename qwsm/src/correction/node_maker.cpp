// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/node_maker.hpp"

#include <utility>

namespace qwsm {

void NodeMaker::GoOn(const MappingStep& step) {
  odometry_ = odometry_ * step.odometry_motion;
  adds_up_ = adds_up_ && step.odometry_adds_up;
}

std::optional<ScanNode> NodeMaker::Take(const MappingStep& step) {
  // Where lasers take turns, the relevant scan is the one before.
  const bool is_before = step.relevant && step.relevant_scan.stamp != step.stamp;
  if (!is_before) GoOn(step);
  if (!step.relevant) return std::nullopt;
  ScanNode node{
      .scan = step.relevant_scan,
      .map_robot = step.map_relevant,
      .odometry = std::exchange(odometry_, {}),
      .T_last_node = {}};
  if (map_last_ && !step.closed_loop) {
    node.T_last_node = adds_up_ ? node.odometry.T_a_b
                                : map_last_->T_a_b.Inverse() * step.map_relevant.T_a_b;
  }
  adds_up_ = true;
  if (is_before) GoOn(step);
  map_last_ = step.map_relevant;
  return node;
}

}  // namespace qwsm
