// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapping_step.hpp"

namespace qwsm {

std::string_view Name(StepStatus status) {
  switch (status) {
    case StepStatus::kFirst:
      return "first";
    case StepStatus::kMatched:
      return "matched";
    case StepStatus::kExtended:
      return "extended";
    case StepStatus::kDeadReckoned:
      return "dead-reckoned";
    case StepStatus::kLost:
      return "lost";
  }
  return "unknown";
}

}  // namespace qwsm
