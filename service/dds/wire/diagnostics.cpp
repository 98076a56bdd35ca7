// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/diagnostics.hpp"

#include <fmt/format.h>

#include <chrono>

#include "service/dds/wire/planar.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::dds {
namespace {

// A robot whose publisher is there and sends nothing for longer is worth a look.
constexpr std::chrono::seconds kSilence{10};

template <class Value>
void Add(Health& health, const char* key, const Value& value) {
  health.values.emplace_back(key, fmt::format("{}", value));
}

void AddMilliseconds(Health& health, const char* key, std::chrono::nanoseconds duration) {
  health.values.emplace_back(
      key, fmt::format("{:.3f}", std::chrono::duration<double, std::milli>(duration).count()));
}

Health HealthOf(const team::RobotStatus& robot) {
  Health health{.name = "qwsm: " + team::DisplayName(robot.name)};
  health.message = Name(robot.state);
  health.level =
      robot.state == team::RobotState::kTracked ? HealthLevel::kOk : HealthLevel::kWarning;
  if (robot.state == team::RobotState::kLost) health.level = HealthLevel::kStale;
  if (robot.state == team::RobotState::kElsewhere) health.level = HealthLevel::kOk;
  // Where it is is known to itself only.
  if (robot.state == team::RobotState::kTracked && !robot.component.empty()) {
    health.message += " in " + team::FrameOf(robot.component);
  }
  const bool is_here =
      robot.state == team::RobotState::kTracked || robot.state == team::RobotState::kUnplaced;
  if (is_here && robot.silence > kSilence) {
    health.level = HealthLevel::kWarning;
    if (robot.state == team::RobotState::kTracked) health.message += ", silent";
  }
  const team::SessionCounts& counts = robot.counts;
  Add(health, "scans", counts.scans);
  Add(health, "answered", counts.answered);
  Add(health, "dead_reckoned", counts.dead_reckoned);
  Add(health, "relevant", counts.relevant);
  Add(health, "without_odometry", counts.without_odometry);
  Add(health, "dropped", counts.dropped);
  Add(health, "duplicates", counts.duplicates);
  Add(health, "late", counts.late);
  Add(health, "wrong_time", counts.wrong_time);
  Add(health, "malformed", counts.malformed);
  Add(health, "unplaced", counts.unplaced);
  Add(health, "clock_resets", counts.clock_resets);
  Add(health, "odometry_readings", counts.odometry_readings);
  Add(health, "odometry_refused", counts.odometry_refused);
  Add(health, "odometry_jumps", counts.odometry_jumps);
  Add(health, "contradicted_poses", counts.contradicted_poses);
  Add(health, "contradicted_mountings", counts.contradicted_mountings);
  Add(health, "waiting", robot.waiting);
  Add(health, "silent_s", std::chrono::duration_cast<std::chrono::seconds>(robot.silence).count());
  AddMilliseconds(health, "matching_median_ms", robot.matching.median);
  AddMilliseconds(health, "matching_p99_ms", robot.matching.p99);
  AddMilliseconds(health, "latency_median_ms", robot.latency.median);
  AddMilliseconds(health, "latency_p99_ms", robot.latency.p99);
  AddMilliseconds(health, "latency_longest_ms", robot.latency.longest);
  return health;
}

Health HealthOf(const team::TeamStatus& status) {
  Health health{.name = "qwsm: service", .message = status.service};
  Add(health, "uptime_s", std::chrono::duration_cast<std::chrono::seconds>(status.uptime).count());
  Add(health, "robots", status.robots.size());
  Add(health, "map_scans", status.map.scans);
  Add(health, "map_points", status.map.points);
  Add(health, "map_corrections", status.map.corrections);
  Add(health, "taken_in", status.map.taken_in);
  Add(health, "taken_in_duplicates", status.map.duplicates);
  Add(health, "taken_in_refused", status.map.refused);
  return health;
}

Health HealthOf(const team::JournalStatus& journal) {
  Health health{.name = "qwsm: journal", .message = journal.file};
  if (!journal.trouble.empty()) {
    health.level = HealthLevel::kError;
    health.message = journal.trouble;
  }
  Add(health, "stored", journal.stored);
  Add(health, "waiting", journal.waiting);
  return health;
}

Health HealthOf(std::span<const Refusals::Kind> refusals) {
  Health health{.name = "qwsm: refused samples", .message = "none"};
  for (const Refusals::Kind& kind : refusals) {
    health.level = HealthLevel::kWarning;
    health.message = "samples made no sense";
    health.values.emplace_back(kind.topic + ": " + kind.why, fmt::format("{}", kind.count));
  }
  return health;
}

}  // namespace

std::vector<Health> HealthOf(const team::TeamStatus& status,
                             std::span<const Refusals::Kind> refusals) {
  std::vector<Health> health{HealthOf(status), HealthOf(refusals)};
  if (!status.journal.file.empty()) health.push_back(HealthOf(status.journal));
  for (const team::RobotStatus& robot : status.robots) health.push_back(HealthOf(robot));
  return health;
}

HealthSample::HealthSample(std::span<const Health> health, Timestamp stamp)
    : values_(health.size()) {
  for (std::size_t i = 0; i < health.size(); ++i) {
    for (const auto& [key, value] : health[i].values) {
      values_[i].push_back({.key = Borrow(key), .value = Borrow(value)});
    }
    const auto size = static_cast<std::uint32_t>(values_[i].size());
    status_.push_back(
        {.level = static_cast<std::uint8_t>(health[i].level),
         .name = Borrow(health[i].name),
         .message = Borrow(health[i].message),
         .hardware_id = Borrow(none_),
         .values = {
             ._maximum = size, ._length = size, ._buffer = values_[i].data(), ._release = false}});
  }
  const auto size = static_cast<std::uint32_t>(status_.size());
  sample_.header = HeaderOf(stamp, none_);
  sample_.status = {
      ._maximum = size, ._length = size, ._buffer = status_.data(), ._release = false};
}

}  // namespace qwsm::dds
