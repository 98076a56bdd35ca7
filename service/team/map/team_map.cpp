// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/team_map.hpp"

#include <algorithm>
#include <utility>

namespace qwsm::team {

namespace {

void Apply(TeamMap::Contents& contents, const TeamMap::Change& change) {
  if (const auto* addition = std::get_if<MapAddition>(&change)) {
    contents.map.Add(*addition);
  } else {
    contents.map = *std::get<std::shared_ptr<const ScanMap>>(change);
    ++contents.epoch;
  }
}

}  // namespace

TeamMap::TeamMap(const ScanMapOptions& options)
    : state_({.map = ScanMap(options), .epoch = 0}, &Apply) {}

std::optional<TeamMap::Insertion> TeamMap::Insert(const TeamScan& scan,
                                                  std::span<const ScanPoint> points) {
  if (!Register(scan)) return std::nullopt;
  ScanId id = 0;
  const std::shared_ptr<const Change> change =
      state_.Write([&](const Contents& contents) -> Change {
        id = static_cast<ScanId>(contents.map.scans().size());
        return contents.map.Prepare(scan.scan, points, scan.map_robot);
      });
  return Insertion{.id = id, .addition = {change, &std::get<MapAddition>(*change)}};
}

void TeamMap::Correct(ScanMap corrected) {
  const auto map = std::make_shared<const ScanMap>(std::move(corrected));
  state_.Write([&](const Contents&) -> Change { return map; });
  const std::lock_guard lock(register_);
  for (const RelevantScan& scan : map->scans()) {
    const ScanKey& key = keys_[scan.id];
    TeamScan& last = last_by_robot_.at(key.robot);
    if (last.key == key) last.map_robot = scan.map_robot;
  }
}

bool TeamMap::Register(const TeamScan& scan) {
  const std::lock_guard lock(register_);
  if (!known_.insert(scan.key).second) return false;
  has_begun_ = true;
  keys_.push_back(scan.key);
  const auto [known, is_first] = last_by_robot_.try_emplace(scan.key.robot);
  TeamScan& last = known->second;
  std::uint64_t& sequence = last_sequence_[{scan.key.service, scan.key.robot}];
  sequence = std::max(sequence, scan.key.sequence);
  // Scans of several services come in any order.
  const bool is_newer = last.key.service == scan.key.service ? last.key.sequence < scan.key.sequence
                                                             : last.scan.stamp < scan.scan.stamp;
  if (!is_first && !is_newer) return true;
  last = {.key = scan.key,
          .scan = {.stamp = scan.scan.stamp, .geometry = scan.scan.geometry, .ranges_m = {}},
          .map_robot = scan.map_robot,
          .T_odom_robot = scan.T_odom_robot};
  return true;
}

std::optional<TeamScan> TeamMap::LastOf(std::string_view robot) const {
  const std::lock_guard lock(register_);
  const auto last = last_by_robot_.find(robot);
  return last == last_by_robot_.end() ? std::nullopt : std::optional(last->second);
}

ScanKey TeamMap::KeyOf(ScanId id) const {
  const std::lock_guard lock(register_);
  return keys_[id];
}

std::uint64_t TeamMap::LastSequence(std::string_view service, std::string_view robot) const {
  const std::lock_guard lock(register_);
  const auto last = last_sequence_.find({std::string(service), std::string(robot)});
  return last == last_sequence_.end() ? 0 : last->second;
}

}  // namespace qwsm::team
