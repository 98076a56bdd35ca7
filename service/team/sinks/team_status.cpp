// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

std::string_view Name(RobotState state) {
  switch (state) {
    case RobotState::kExpected:
      return "expected";
    case RobotState::kUnplaced:
      return "unplaced";
    case RobotState::kTracked:
      return "tracked";
    case RobotState::kLost:
      return "lost";
    case RobotState::kElsewhere:
      return "answered by another service";
  }
  return "unknown";
}

}  // namespace qwsm::team
