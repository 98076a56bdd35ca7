// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/match_result.hpp"

namespace qwsm {

std::string_view Name(MatchStatus status) {
  switch (status) {
    case MatchStatus::kConverged:
      return "converged";
    case MatchStatus::kIterationLimit:
      return "iteration limit";
    case MatchStatus::kTooFewPairs:
      return "too few pairs";
    case MatchStatus::kDegenerate:
      return "degenerate";
    case MatchStatus::kInconsistent:
      return "inconsistent";
  }
  return "unknown";
}

}  // namespace qwsm
