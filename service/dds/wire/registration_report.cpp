// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/registration_report.hpp"

#include "service/dds/wire/report_fields.hpp"
#include "service/dds/wire/spatial.hpp"

namespace qwsm::dds {

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
  if (!report) return std::nullopt;
  report->map_robot = {.T_a_b = SpatialPose(sample.pose.pose),
                       .covariance = SpatialCovariance(sample.pose.covariance)};
  report->points = sample.points;
  report->rms_residual_m = sample.rms_residual;
  report->loops_to.assign(sample.loops._buffer, sample.loops._buffer + sample.loops._length);
  return report;
}

}  // namespace qwsm::dds
