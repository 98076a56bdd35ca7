// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/report_conversion.hpp"

#include "qwsm/geometry/position.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/report_fields.hpp"

namespace qwsm::dds {

MatchReport ReportOf(const team::RobotAnswer& answer) {
  const MappingStep& step = answer.step;
  const MatchResult& match = step.match;
  return {.robot = answer.robot,
          .stamp = step.stamp,
          .map_robot = step.map_robot,
          .status = step.status,
          .reason = std::string(step.reason),
          .relevant = step.relevant,
          .pairs = static_cast<std::uint32_t>(match.pairs),
          .iterations = static_cast<std::uint32_t>(match.iterations),
          .overlap = match.overlap,
          .mean_residual_m = match.mean_residual_m,
          .position_trace_m2 = match.covariance(0, 0) + match.covariance(1, 1),
          .duration = answer.matching,
          .latency = answer.latency,
          .scans = answer.scans,
          .dropped = answer.dropped};
}

wire::MatchReport ToWire(const MatchReport& report, const std::string& map_frame) {
  wire::MatchReport sample{};
  AddCommonFields(report, map_frame, sample);
  sample.pose = ToWire2D(report.map_robot.T_a_b);
  CopyCovariance(report.map_robot.covariance, sample.covariance);
  sample.relevant = report.relevant;
  sample.mean_residual = report.mean_residual_m;
  sample.position_trace = report.position_trace_m2;
  return sample;
}

std::optional<MatchReport> FromWire(const wire::MatchReport& sample) {
  auto report = CommonFieldsOf<MatchReport>(sample, StepStatus::kLost);
  if (!report || !IsPosition(FromWire(sample.pose))) return std::nullopt;
  report->map_robot = {.T_a_b = FromWire(sample.pose),
                       .covariance = CovarianceOf(sample.covariance)};
  report->relevant = sample.relevant;
  report->mean_residual_m = sample.mean_residual;
  report->position_trace_m2 = sample.position_trace;
  return report;
}

}  // namespace qwsm::dds
