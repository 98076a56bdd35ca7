// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {

/// Fills the fields that reports on scans of every kind have.
/// @param sample borrows from the report and the name of the frame.
template <class Report, class Sample>
void AddCommonFields(const Report& report, const std::string& map_frame, Sample& sample) {
  sample.header = HeaderOf(report.stamp, map_frame);
  sample.robot = Borrow(report.robot);
  sample.status = static_cast<std::uint8_t>(report.status);
  sample.reason = Borrow(report.reason);
  sample.pairs = report.pairs;
  sample.iterations = report.iterations;
  sample.overlap = report.overlap;
  sample.duration = Seconds(report.duration);
  sample.latency = Seconds(report.latency);
  sample.scans = report.scans;
  sample.dropped = report.dropped;
}

/// Makes a report with the fields of every kind; nothing where its stamp is none, or its status is
/// beyond the last.
template <class Report, class Sample, class Status>
std::optional<Report> CommonFieldsOf(const Sample& sample, Status last_status) {
  const std::optional<Timestamp> stamp = FromWire(sample.header.stamp);
  if (!stamp || sample.status > static_cast<std::uint8_t>(last_status)) return std::nullopt;
  Report report;
  report.robot = sample.robot;
  report.stamp = *stamp;
  report.status = static_cast<Status>(sample.status);
  report.reason = sample.reason;
  report.pairs = sample.pairs;
  report.iterations = sample.iterations;
  report.overlap = sample.overlap;
  report.duration = Nanoseconds(sample.duration);
  report.latency = Nanoseconds(sample.latency);
  report.scans = sample.scans;
  report.dropped = sample.dropped;
  return report;
}

}  // namespace qwsm::dds
