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

std::uint64_t NextNumber() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

TeamMap::TeamMap(const ScanMapOptions& options)
    : TeamMap(options, {.map = NextNumber(), .epoch = 0}) {}

TeamMap::TeamMap(const ScanMapOptions& options, const MapVersion& version)
    : number_(version.map), state_({.map = ScanMap(options), .epoch = version.epoch}, &Apply) {}

TeamMap::TeamMap(const TeamMap& other) : TeamMap(other, Lock(other.insertion_, other.register_)) {}

TeamMap::TeamMap(const TeamMap& other, const Lock&)
    : number_(other.number_),
      state_(*other.Read(), &Apply),
      has_begun_(other.has_begun_.load()),
      id_of_(other.id_of_),
      heads_(other.heads_),
      by_robot_(other.by_robot_),
      last_sequence_(other.last_sequence_) {}

std::shared_ptr<TeamMap> TeamMap::EmptyNextVersion() const {
  const State::View contents = Read();
  return std::shared_ptr<TeamMap>(
      new TeamMap(contents->map.options(), {.map = number_, .epoch = contents->epoch + 1}));
}

std::optional<TeamMap::Insertion> TeamMap::Insert(const TeamScan& scan,
                                                  std::span<const ScanPoint> points) {
  const std::lock_guard lock(insertion_);
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
  for (const RelevantScan& scan : map->scans()) heads_[scan.id].map_robot = scan.map_robot;
}

bool TeamMap::Register(const TeamScan& scan) {
  const std::lock_guard lock(register_);
  const auto id = static_cast<ScanId>(heads_.size());
  if (!id_of_.try_emplace(scan.key, id).second) return false;
  has_begun_ = true;
  heads_.push_back(
      {.key = scan.key,
       .component = scan.component,
       .scan = {.stamp = scan.scan.stamp, .geometry = scan.scan.geometry, .ranges_m = {}},
       .map_robot = scan.map_robot,
       .T_odom_robot = scan.T_odom_robot,
       .is_new_start = scan.is_new_start,
       .motion = scan.motion});
  std::uint64_t& sequence = last_sequence_[{scan.key.service, scan.key.robot}];
  sequence = std::max(sequence, scan.key.sequence);
  auto& [count, last] =
      by_robot_.try_emplace(scan.key.robot, ScansOfRobot{.last = id}).first->second;
  ++count;
  // Scans of several services come in any order.
  const TeamScan& known = heads_[last];
  const bool is_newer = known.key.service == scan.key.service
                            ? known.key.sequence < scan.key.sequence
                            : known.scan.stamp < scan.scan.stamp;
  if (is_newer) last = id;
  return true;
}

std::optional<TeamScan> TeamMap::LastOf(std::string_view robot) const {
  const std::lock_guard lock(register_);
  const auto known = by_robot_.find(robot);
  return known == by_robot_.end() ? std::nullopt : std::optional(heads_[known->second.last]);
}

std::vector<std::string> TeamMap::Robots() const {
  const std::lock_guard lock(register_);
  std::vector<std::string> robots;
  for (const auto& [robot, scans] : by_robot_) robots.push_back(robot);
  return robots;
}

std::size_t TeamMap::CountOf(std::string_view robot) const {
  const std::lock_guard lock(register_);
  const auto known = by_robot_.find(robot);
  return known == by_robot_.end() ? 0 : known->second.count;
}

TeamScan TeamMap::HeadOf(ScanId id) const {
  const std::lock_guard lock(register_);
  return heads_[id];
}

ScanKey TeamMap::KeyOf(ScanId id) const {
  const std::lock_guard lock(register_);
  return heads_[id].key;
}

std::optional<ScanId> TeamMap::Find(const ScanKey& key) const {
  const std::lock_guard lock(register_);
  const auto known = id_of_.find(key);
  return known == id_of_.end() ? std::nullopt : std::optional(known->second);
}

// The register is locked for each scan anew: who answers a robot asks it, too.
std::vector<TeamScan> TeamMap::Scans(ScanId first, std::size_t most) const {
  const State::View contents = Read();
  const auto from = std::span(contents->map.scans()).subspan(first);
  std::vector<TeamScan> scans;
  for (const RelevantScan& scan : from.first(std::min(most, from.size()))) {
    TeamScan& one = scans.emplace_back(HeadOf(scan.id));
    one.scan = scan.scan;
    one.map_robot = scan.map_robot;
  }
  return scans;
}

std::uint64_t TeamMap::LastSequence(std::string_view service, std::string_view robot) const {
  const std::lock_guard lock(register_);
  const auto last = last_sequence_.find({std::string(service), std::string(robot)});
  return last == last_sequence_.end() ? 0 : last->second;
}

}  // namespace qwsm::team
