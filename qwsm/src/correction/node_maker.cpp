// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/node_maker.hpp"

#include <utility>

namespace qwsm {

std::optional<ScanNode> NodeMaker::Take(const MappingStep& step) {
  // Where lasers take turns, the relevant scan is the one before.
  const bool is_before = step.relevant && step.relevant_scan.stamp != step.stamp;
  if (!is_before) odometry_ = odometry_ * step.odometry_motion;
  if (!step.relevant) return std::nullopt;
  ScanNode node{
      .scan = step.relevant_scan,
      .map_robot = step.map_relevant,
      .odometry = std::exchange(odometry_, is_before ? step.odometry_motion : UncertainPose2{}),
      .T_last_node = {}};
  if (map_last_ && !step.closed_loop) {
    node.T_last_node = map_last_->T_a_b.Inverse() * step.map_relevant.T_a_b;
  }
  map_last_ = step.map_relevant;
  return node;
}

}  // namespace qwsm
