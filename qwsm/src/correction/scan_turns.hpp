// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/graph/pose_graph.hpp"

namespace qwsm {

/// The turns in which the lasers of one robot scan: each laser once. What they see in a turn is
/// what one laser that looks all around sees in a scan. Of an only laser each scan is a turn.
/// Lasers are told apart by where they sit on the robot.
class ScanTurns {
 public:
  /// What a scan is in its turn.
  struct Part {
    std::size_t turn = 0;   ///< Number of the turn.
    bool begins = true;     ///< Whether it is the first one.
    bool completes = true;  ///< Whether it is the last one, if as many lasers scan as before.
    std::vector<NodeId> beside{};  ///< What the other lasers saw since this one scanned before.
  };

  /// Takes the robot's next scan.
  Part Take(NodeId node, const Pose2& T_robot_laser);

 private:
  struct Laser {
    Pose2 T_robot_laser;
    NodeId node = 0;  // Its last scan.
  };

  std::vector<Laser> lasers_;  // In the order they scanned.
  NodeId first_ = 0;           // Of the turn.
  std::size_t turn_ = 0;
  std::size_t scans_ = 0;     // In the turn so far.
  std::size_t expected_ = 1;  // In the turn: as many as in the one before.
};

}  // namespace qwsm
