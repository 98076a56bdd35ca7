// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/entities/participant.hpp"
#include "service/dds/wire/match_report.hpp"
#include "service/dds/wire/registration_report.hpp"
#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::dds {

/// The report on a scan of a kind: planar or spatial.
template <class Kind>
struct ReportOn;
template <>
struct ReportOn<team::Planar> {
  using Type = MatchReport;
};
template <>
struct ReportOn<team::Spatial> {
  using Type = RegistrationReport;
};

/// Hears what services report on robots.
/// @tparam Kind team::Planar or team::Spatial.
template <class Kind>
class BasicReportReader {
 public:
  using Report = typename ReportOn<Kind>::Type;

  /// Subscribes to the reports on some robots.
  /// @param robots names as in RobotNames; where empty, all there are and that join later.
  /// @throws DdsError.
  BasicReportReader(const Participant& participant, const std::vector<std::string>& robots);
  ~BasicReportReader();

  /// Whether some service reports on these robots.
  bool has_writer() const;
  /// All reports that arrived since the last call; waits for the first one if there is none.
  std::vector<Report> Take(std::chrono::nanoseconds timeout);

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

using MatchReportReader = BasicReportReader<team::Planar>;
using RegistrationReportReader = BasicReportReader<team::Spatial>;

extern template class BasicReportReader<team::Planar>;
extern template class BasicReportReader<team::Spatial>;

}  // namespace qwsm::dds
