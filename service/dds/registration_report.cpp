// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/registration_report.hpp"

#include "service/dds/planar.hpp"
#include "service/dds/spatial.hpp"

namespace qwsm::dds {

wire::RegistrationReport ToWire(const RegistrationReport& report, const std::string& map_frame) {
  wire::RegistrationReport sample{};
  sample.header = HeaderOf(report.stamp, map_frame);
  sample.robot = Borrow(report.robot);
  sample.pose.pose = ToWire(report.map_robot.T_a_b);
  CopyCovariance(report.map_robot.covariance, sample.pose.covariance);
  sample.status = static_cast<std::uint8_t>(report.status);
  sample.reason = Borrow(report.reason);
  sample.points = report.points;
  sample.pairs = report.pairs;
  sample.iterations = report.iterations;
  sample.overlap = report.overlap;
  sample.rms_residual = report.rms_residual_m;
  const auto loops = static_cast<std::uint32_t>(report.loops_to.size());
  sample.loops = {._maximum = loops,
                  ._length = loops,
                  ._buffer = const_cast<std::uint32_t*>(report.loops_to.data()),
                  ._release = false};
  sample.duration = Seconds(report.duration);
  sample.latency = Seconds(report.latency);
  sample.scans = report.scans;
  sample.dropped = report.dropped;
  return sample;
}

std::optional<RegistrationReport> FromWire(const wire::RegistrationReport& sample) {
  const std::optional<Timestamp> stamp = FromWire(sample.header.stamp);
  const bool is_known = sample.status <= static_cast<std::uint8_t>(slam6d::SlamStatus::kUnusable);
  if (!stamp || !is_known) return std::nullopt;
  RegistrationReport report;
  report.robot = sample.robot;
  report.stamp = *stamp;
  report.map_robot = {.T_a_b = SpatialPose(sample.pose.pose),
                      .covariance = SpatialCovariance(sample.pose.covariance)};
  report.status = static_cast<slam6d::SlamStatus>(sample.status);
  report.reason = sample.reason;
  report.points = sample.points;
  report.pairs = sample.pairs;
  report.iterations = sample.iterations;
  report.overlap = sample.overlap;
  report.rms_residual_m = sample.rms_residual;
  report.loops_to.assign(sample.loops._buffer, sample.loops._buffer + sample.loops._length);
  report.duration = Nanoseconds(sample.duration);
  report.latency = Nanoseconds(sample.latency);
  report.scans = sample.scans;
  report.dropped = sample.dropped;
  return report;
}

}  // namespace qwsm::dds
