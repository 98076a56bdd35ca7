// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/match_report.hpp"
#include "service/dds/participant.hpp"

namespace qwsm::dds {

/// Hears what services report on robots.
class MatchReportReader {
 public:
  /// @param robots names as in RobotNames; where empty, all there are and that join later.
  /// @throws DdsError.
  MatchReportReader(const Participant& participant, const std::vector<std::string>& robots);
  ~MatchReportReader();

  /// Whether some service reports.
  bool has_writer() const;
  /// All that arrived since the last call; waits for the first one if there is none.
  std::vector<MatchReport> Take(std::chrono::nanoseconds timeout);

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace qwsm::dds
