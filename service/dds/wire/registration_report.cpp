// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/registration_report.hpp"

#include "service/dds/wire/report_fields.hpp"
#include "service/dds/wire/spatial.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::dds {

RegistrationReport ReportOf(const team::CloudAnswer& answer) {
  const slam6d::SlamStep& registration = answer.step.registration;
  const slam6d::SlamStatus status = registration.status;
  const bool has_match =
      status == slam6d::SlamStatus::kMatched || status == slam6d::SlamStatus::kDeadReckoned;
  return {.robot = answer.robot,
          .stamp = answer.step.stamp,
          .map_robot = answer.step.map_robot,
          .status = status,
          .reason = std::string(has_match ? Name(registration.match.status) : Name(status)),
          .points = static_cast<std::uint32_t>(registration.points),
          .pairs = static_cast<std::uint32_t>(registration.match.pairs),
          .iterations = static_cast<std::uint32_t>(registration.match.iterations),
          .overlap = registration.overlap,
          .rms_residual_m = registration.match.rms_residual_m,
          .loops_to = {registration.loops_to.begin(), registration.loops_to.end()},
          .duration = answer.matching,
          .latency = answer.latency,
          .scans = answer.scans,
          .dropped = answer.dropped};
}

wire::RegistrationReport ToWire(const RegistrationReport& report, const std::string& map_frame) {
  wire::RegistrationReport sample{};
  AddCommonFields(report, map_frame, sample);
  sample.pose.pose = ToWire(report.map_robot.T_a_b);
  CopyCovariance(report.map_robot.covariance, sample.pose.covariance);
  sample.points = report.points;
  sample.rms_residual = report.rms_residual_m;
  const auto loops = static_cast<std::uint32_t>(report.loops_to.size());
  sample.loops = {._maximum = loops,
                  ._length = loops,
                  ._buffer = const_cast<std::uint32_t*>(report.loops_to.data()),
                  ._release = false};
  return sample;
}

std::optional<RegistrationReport> FromWire(const wire::RegistrationReport& sample) {
  auto report = CommonFieldsOf<RegistrationReport>(sample, slam6d::SlamStatus::kUnusable);
  if (!report || !slam6d::IsPosition(SpatialPose(sample.pose.pose))) return std::nullopt;
  report->map_robot = {.T_a_b = SpatialPose(sample.pose.pose),
                       .covariance = SpatialCovariance(sample.pose.covariance)};
  report->points = sample.points;
  report->rms_residual_m = sample.rms_residual;
  report->loops_to.assign(sample.loops._buffer, sample.loops._buffer + sample.loops._length);
  return report;
}

}  // namespace qwsm::dds
