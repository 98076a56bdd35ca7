// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "service/dds/entities/wire_types.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::dds {

/// Levels of diagnostic_msgs/DiagnosticStatus.
enum class HealthLevel : std::uint8_t { kOk = 0, kWarning = 1, kError = 2, kStale = 3 };

/// How one part of the service is, in words and figures.
struct Health {
  HealthLevel level = HealthLevel::kOk;
  std::string name{};
  std::string message{};
  std::vector<std::pair<std::string, std::string>> values{};
};

/// The health of the service, of its journal, of each robot, and of what was refused.
std::vector<Health> HealthOf(const team::TeamStatus& status,
                             std::span<const Refusals::Kind> refusals);

/// Health as a sample, which points into this object and into what it was made of.
class HealthSample {
 public:
  HealthSample(std::span<const Health> health, Timestamp stamp);
  HealthSample(const HealthSample&) = delete;
  HealthSample& operator=(const HealthSample&) = delete;

  const wire::DiagnosticArray& sample() const { return sample_; }

 private:
  std::string none_;
  std::vector<std::vector<wire::KeyValue>> values_;
  std::vector<wire::DiagnosticStatus> status_;
  wire::DiagnosticArray sample_{};
};

}  // namespace qwsm::dds
