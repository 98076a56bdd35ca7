// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/dds/entities/wire_types.hpp"
#include "service/team/sinks/service_sink.hpp"
#include "slam6d/mapping/slam.hpp"

namespace qwsm::dds {

/// What became of one 3D scan, as it is told on the network (qwsm_msgs/RegistrationReport).
struct RegistrationReport {
  std::string robot;
  Timestamp stamp{};
  slam6d::UncertainPose3 map_robot;
  slam6d::SlamStatus status = slam6d::SlamStatus::kFirst;
  std::string reason;
  std::uint32_t points = 0;  ///< Points of the scan after the reduction.
  std::uint32_t pairs = 0;
  std::uint32_t iterations = 0;
  double overlap = 0.0;
  double rms_residual_m = 0.0;
  std::vector<std::uint32_t> loops_to{};  ///< Earlier scans with which a loop was closed.
  std::chrono::nanoseconds duration{};    ///< Time that the registration took.
  std::chrono::nanoseconds latency{};     ///< From the scan's arrival to its pose.
  std::uint64_t scans = 0;                ///< Scans of this robot so far.
  std::uint64_t dropped = 0;  ///< Scans of this robot that were left out: the queue was full.
};

/// The report that tells others what an answer says.
RegistrationReport ReportOf(const team::CloudAnswer& answer);

/// Makes a sample that points into the report and the name of the frame: write it while both live.
wire::RegistrationReport ToWire(const RegistrationReport& report, const std::string& map_frame);

/// The report of a sample; nothing where the sample makes no sense.
std::optional<RegistrationReport> FromWire(const wire::RegistrationReport& sample);

}  // namespace qwsm::dds
