// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scan_turns.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "qwsm/sensor/laser_mountings.hpp"

namespace qwsm {

// A turn ends when one of its lasers scans again.
ScanTurns::Part ScanTurns::Take(NodeId node, const Pose2& T_robot_laser) {
  auto laser = std::ranges::find(lasers_, T_robot_laser, &Laser::T_robot_laser);
  const bool is_known = laser != lasers_.end();
  Part part;
  part.begins =
      lasers_.empty() || lasers_.size() == kMostMountings || (is_known && laser->node >= first_);
  if (part.begins && !lasers_.empty()) {
    ++turn_;
    expected_ = std::exchange(scans_, 0);
  }
  if (part.begins) first_ = node;
  part.turn = turn_;
  part.completes = ++scans_ == expected_;
  if (is_known) laser = lasers_.erase(laser);
  for (laser = is_known ? laser : lasers_.begin(); laser != lasers_.end(); ++laser) {
    part.beside.push_back(laser->node);
  }
  if (lasers_.size() == kMostMountings) lasers_.erase(lasers_.begin());
  lasers_.push_back({T_robot_laser, node});
  return part;
}

}  // namespace qwsm
