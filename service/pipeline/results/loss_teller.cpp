// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/loss_teller.hpp"

#include <utility>

#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

void LossTeller::Take(const MappingStep& step) {
  ++scans_;
  if (std::exchange(losses_, mapper_.losses()) < mapper_.losses()) {
    messages::Warn(
        "scan {}: the robot is lost: what it sees contradicts what it had mapped before; was it "
        "carried, or has the log a gap?",
        scans_);
    is_lost_ = true;
  }
  if (!is_lost_ || mapper_.belief() != nullptr) return;
  messages::Info("scan {}: the robot is found again at {:.2f} {:.2f} in the map",
                 scans_,
                 step.map_robot.T_a_b.x_m,
                 step.map_robot.T_a_b.y_m);
  is_lost_ = false;
}

void LossTeller::Finish() const {
  if (!is_lost_) return;
  messages::Warn(
      "the robot was not found again: from where it was lost its path is one of its own, and what "
      "it saw is not in the map; --continue goes on with the map");
}

}  // namespace qwsm::pipeline
