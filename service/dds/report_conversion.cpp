// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/report_conversion.hpp"

#include "service/dds/planar.hpp"

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
  sample.header = HeaderOf(report.stamp, map_frame);
  sample.robot = Borrow(report.robot);
  sample.pose = ToWire2D(report.map_robot.T_a_b);
  CopyCovariance(report.map_robot.covariance, sample.covariance);
  sample.status = static_cast<std::uint8_t>(report.status);
  sample.reason = Borrow(report.reason);
  sample.relevant = report.relevant;
  sample.pairs = report.pairs;
  sample.iterations = report.iterations;
  sample.overlap = report.overlap;
  sample.mean_residual = report.mean_residual_m;
  sample.position_trace = report.position_trace_m2;
  sample.duration = Seconds(report.duration);
  sample.latency = Seconds(report.latency);
  sample.scans = report.scans;
  sample.dropped = report.dropped;
  return sample;
}

std::optional<MatchReport> FromWire(const wire::MatchReport& sample) {
  const std::optional<Timestamp> stamp = FromWire(sample.header.stamp);
  const bool is_known = sample.status <= static_cast<std::uint8_t>(StepStatus::kDeadReckoned);
  if (!stamp || !is_known) return std::nullopt;
  MatchReport report;
  report.robot = sample.robot;
  report.stamp = *stamp;
  report.map_robot = {.T_a_b = FromWire(sample.pose),
                      .covariance = CovarianceOf(sample.covariance)};
  report.status = static_cast<StepStatus>(sample.status);
  report.reason = sample.reason;
  report.relevant = sample.relevant;
  report.pairs = sample.pairs;
  report.iterations = sample.iterations;
  report.overlap = sample.overlap;
  report.mean_residual_m = sample.mean_residual;
  report.position_trace_m2 = sample.position_trace;
  report.duration = Nanoseconds(sample.duration);
  report.latency = Nanoseconds(sample.latency);
  report.scans = sample.scans;
  report.dropped = sample.dropped;
  return report;
}

}  // namespace qwsm::dds
