// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "qwsm/mapping/mapping_step.hpp"

namespace qwsm::dds {

/// What became of one scan, as it is told on the network (qwsm_msgs/MatchReport).
struct MatchReport {
  std::string robot;
  Timestamp stamp{};
  UncertainPose2 map_robot;
  StepStatus status = StepStatus::kFirst;
  std::string reason;
  bool relevant = false;
  std::uint32_t pairs = 0;
  std::uint32_t iterations = 0;
  double overlap = 0.0;
  double mean_residual_m = 0.0;
  double position_trace_m2 = 0.0;
  std::chrono::nanoseconds duration{};  ///< Time that matching took.
  std::chrono::nanoseconds latency{};   ///< From the scan's arrival to its pose.
  std::uint64_t scans = 0;              ///< Scans of this robot so far.
  std::uint64_t dropped = 0;  ///< Scans of this robot that were left out: the queue was full.
};

}  // namespace qwsm::dds
