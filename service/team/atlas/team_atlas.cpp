// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/team_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "service/team/journal/journaled_map.hpp"
#include "service/team/map/yielding.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::team {
namespace {

std::vector<UncertainPose2> PosesOf(std::span<const Placement> places) {
  std::vector<UncertainPose2> poses;
  poses.reserve(places.size());
  for (const Placement& place : places) poses.push_back(place.map_robot);
  return poses;
}

bool IsCorrected(const TeamMap& map, const std::vector<Placement>& wanted) {
  const TeamMap::State::View contents = map.Read();
  return !std::ranges::equal(
      contents->map.scans(), wanted, [](const RelevantScan& scan, const Placement& place) {
        return scan.map_robot.T_a_b == place.map_robot.T_a_b;
      });
}

// Where robots have a map each, each one's frame is called like that of the team's.
void LeaveOutComponents(TeamEpoch& epoch) {
  for (MovedScan& scan : epoch.scans) {
    scan.component.clear();
    scan.component_before.clear();
  }
}

}  // namespace

TeamAtlas::TeamAtlas(const TeamAtlasOptions& options, AtlasSurroundings surroundings)
    : options_(options),
      surroundings_(std::move(surroundings)),
      maps_(options.sharing, options.mapper.map) {}

void TeamAtlas::Restore(TeamScan scan, const std::string& component) {
  const std::lock_guard lock(extension_);
  const MapComponent home = IsTeams() ? maps_.Named(component) : maps_.Of(scan.key.robot);
  if (!home.map->Insert(scan, ToPoints(scan.scan))) return;
  maps_.Put(scan.key.robot, home.name);
  maps_.Reserve(scan.component);
  CatchUp(home);
}

// Nobody hears of a relevant scan before it is safe: who has heard of it may rely on it.
bool TeamAtlas::Extend(const TeamScan& scan,
                       std::span<const ScanPoint> points,
                       const MapVersion& answered_in) {
  const std::lock_guard lock(extension_);
  const MapComponent component = maps_.Of(scan.key.robot);
  if (component.map->version() != answered_in) return false;
  const std::optional<TeamMap::Insertion> insertion = component.map->Insert(scan, points);
  if (!insertion) return true;
  surroundings_.keep(ToJournal(scan), [this, shared = std::make_shared<TeamScan>(scan), insertion] {
    surroundings_.sinks.Tell(&TeamSink::TakeRelevantScan, *shared);
    TellNewPoints(*shared, *insertion->addition);
  });
  joined_.erase(component.name);
  CatchUp(component);
  CorrectIfDue(component);
  return true;
}

bool TeamAtlas::TakeIn(TeamScan scan) {
  const std::vector<ScanPoint> points = ToPoints(scan.scan);
  const std::lock_guard lock(extension_);
  Settle(scan);
  const MapComponent component = IsTeams() ? maps_.Named(scan.component) : maps_.Of(scan.key.robot);
  if (!component.map->Insert(scan, points)) return false;
  maps_.Put(scan.key.robot, component.name);
  surroundings_.keep(ToJournal(scan), [] {});
  joined_.erase(component.name);
  CatchUp(component);
  CorrectIfDue(component);
  of_others_.push_back(std::move(scan));
  return true;
}

// Whether a component is what it was: it may be none any more.
bool TeamAtlas::IsStill(const std::string& component, const MapVersion& version) {
  return maps_.Has(component) && maps_.Named(component).map->version() == version;
}

// Scans may be heard of after what has become of them.
void TeamAtlas::Settle(TeamScan& scan) const {
  if (const auto told = told_.find(scan.key); told != told_.end()) {
    scan.component = told->second.component;
    scan.map_robot = told->second.map_robot;
    return;
  }
  const auto joined = joined_.find(scan.component);
  if (joined == joined_.end()) return;
  scan.component = joined->second.component;
  scan.map_robot = UncertainPose2{.T_a_b = joined->second.T_into_from} * scan.map_robot;
}

void TeamAtlas::TakeIn(const TeamEpoch& epoch) {
  Placements told;
  for (const MovedScan& scan : epoch.scans) {
    told[scan.key] = {.component = scan.component, .map_robot = scan.map_robot};
  }
  Rearrange([&]() -> std::optional<Plan> {
    if (!options_.corrects || !IsTeams() || epoch.rank <= epoch_) return std::nullopt;
    told_ = told;
    Rearrangement wanted = Follow(maps_, told_);
    // Whoever knows of scans that the other one did not tells where these are now.
    return Plan{.rank = wanted.moves_others ? Next(epoch.rank) : epoch.rank,
                .rearrangement = std::move(wanted)};
  });
}

std::vector<TeamScan> TeamAtlas::TakenIn() {
  const std::lock_guard lock(extension_);
  return std::exchange(of_others_, {});
}

bool TeamAtlas::Join(const ComponentPlace& place) {
  return Rearrange([&]() -> std::optional<Plan> {
    if (!IsStill(place.from_name, place.from) || !IsStill(place.into_name, place.into)) {
      return std::nullopt;
    }
    Rearrangement wanted = AsTheyAre(maps_);
    for (Placement& one : wanted.wanted.at(place.from_name)) {
      one = {.component = place.into_name, .map_robot = place.into_from * one.map_robot};
    }
    return Plan{.rank = Next(epoch_), .rearrangement = std::move(wanted)};
  });
}

bool TeamAtlas::Part(const std::string& robot,
                     const MapVersion& from,
                     const std::string& from_name) {
  const std::string own = maps_.NewNameFor(robot);
  const bool has_parted = Rearrange([&]() -> std::optional<Plan> {
    if (!IsStill(from_name, from)) return std::nullopt;
    const MapComponent component = maps_.Named(from_name);
    Rearrangement wanted = AsTheyAre(maps_);
    std::optional<Pose2> T_own_map;
    std::vector<Placement>& places = wanted.wanted.at(from_name);
    for (std::size_t id = 0; id < places.size(); ++id) {
      if (component.map->KeyOf(static_cast<ScanId>(id)).robot != robot) continue;
      Placement& place = places[id];
      if (!T_own_map) T_own_map = place.map_robot.T_a_b.Inverse();
      place = {.component = own,
               .map_robot = UncertainPose2{.T_a_b = *T_own_map} * place.map_robot};
    }
    if (!T_own_map) return std::nullopt;
    return Plan{.rank = Next(epoch_), .rearrangement = std::move(wanted)};
  });
  if (!has_parted) maps_.GiveBack(own);
  return has_parted;
}

// The correctors know the scans of their maps, in the same order.
void TeamAtlas::CatchUp(const MapComponent& component) {
  if (!options_.corrects || is_rearranged_) return;
  TeamCorrector& corrector = CorrectorOf(component.name);
  for (const TeamScan& scan : component.map->Scans(static_cast<ScanId>(corrector.size()))) {
    corrector.Take(scan);
  }
}

void TeamAtlas::CorrectIfDue(const MapComponent& component) {
  if (!options_.corrects || is_rearranged_) return;
  std::optional<CorrectedMap> corrected = CorrectorOf(component.name).LookIfDue();
  if (!corrected) return;
  Rearrangement wanted = AsTheyAre(maps_);
  std::vector<Placement>& places = wanted.wanted.at(component.name);
  for (std::size_t id = 0; id < places.size(); ++id) {
    places[id].map_robot = corrected->map_node[id];
  }
  epoch_ = Next(epoch_);
  TeamEpoch epoch = EpochOf(maps_, wanted, epoch_);
  component.map->Correct(std::move(corrected->map));
  Tell(std::move(epoch));
}

EpochRank TeamAtlas::Next(const EpochRank& last) const {
  return {.number = last.number + 1, .service = surroundings_.service()};
}

// The maps are made beside the robots, which are answered in the old ones and extend these, in a
// thread that gives way to them. Nobody waits but for the end, when what came meanwhile finds its
// place.
bool TeamAtlas::Rearrange(const Planner& plan) {
  const std::lock_guard one_at_a_time(rearranging_);
  RearrangedMaps made;
  std::unique_lock lock(extension_);
  std::optional<Plan> now = plan();
  if (!now) return false;
  is_rearranged_ = true;
  lock.unlock();
  DoYielding([&] { made.Follow(maps_, now->rearrangement); });
  lock.lock();
  is_rearranged_ = false;
  now = plan();
  if (now) {
    made.Follow(maps_, now->rearrangement);
    epoch_ = now->rank;
    TakeEffect(now->rearrangement, made);
  }
  for (const MapComponent& component : maps_.All()) CatchUp(component);
  return now.has_value();
}

void TeamAtlas::TakeEffect(const Rearrangement& rearrangement, const RearrangedMaps& made) {
  TeamEpoch epoch = EpochOf(maps_, rearrangement, epoch_);
  std::map<std::string, std::string> home_of_robot;
  const auto map_of_component = made.maps();
  for (const auto& [name, wanted] : rearrangement.wanted) {
    const bool loses_scans = std::ranges::any_of(
        wanted, [&, &of = name](const Placement& place) { return place.component != of; });
    if (loses_scans) {
      const bool is_none = map_of_component.at(name) == nullptr;
      if (is_none) NoteJoined(name, wanted.back());
      Leave(name, wanted, home_of_robot);
    } else if (IsCorrected(*maps_.Named(name).map, wanted)) {
      CorrectorOf(name).Adopt(PosesOf(std::span(wanted).first(CorrectorOf(name).size())));
    }
  }
  for (const auto& [name, map] : map_of_component) {
    if (map) joined_.erase(name);
    if (maps_.Has(name)) outdated_.push_back(maps_.Named(name).map);
  }
  maps_.Exchange(map_of_component, home_of_robot);
  Tell(std::move(epoch));
}

// Its map is another one from now on, if it has one.
void TeamAtlas::Leave(const std::string& component,
                      const std::vector<Placement>& wanted,
                      std::map<std::string, std::string>& home_of_robot) {
  const std::vector<TeamScan> scans = maps_.Named(component).map->Scans();
  for (std::size_t id = 0; id < scans.size(); ++id) {
    const std::string& robot = scans[id].key.robot;
    if (maps_.Of(robot).name == component) home_of_robot[robot] = wanted[id].component;
  }
  if (auto corrector = correctors_.extract(component)) retired_.push_back(std::move(corrector));
}

// Those that had become part of it are now part of the other one, too: wherever a scan belongs is
// found by looking once.
// @param last where its last scan is now.
void TeamAtlas::NoteJoined(const std::string& component, const Placement& last) {
  const Pose2 before = maps_.Named(component).map->Read()->map.scans().back().map_robot.T_a_b;
  const Pose2 T_into_from = last.map_robot.T_a_b * before.Inverse();
  for (auto& [name, joined] : joined_) {
    if (joined.component != component) continue;
    joined = {.component = last.component, .T_into_from = T_into_from * joined.T_into_from};
  }
  joined_[component] = {.component = last.component, .T_into_from = T_into_from};
}

std::optional<Correction> TeamAtlas::Finish(const std::string& component) {
  const std::lock_guard lock(extension_);
  const MapComponent home = maps_.Named(component);
  const bool is_empty = home.map->Read()->map.empty();
  if (!options_.corrects || is_empty || IsKnownToOthers(*home.map)) return std::nullopt;
  CatchUp(home);
  return CorrectorOf(component).Finish();
}

bool TeamAtlas::IsKnownToOthers(const TeamMap& map) const {
  const std::string service = surroundings_.service();
  return std::ranges::any_of(map.Read()->map.scans(), [&](const RelevantScan& scan) {
    return map.KeyOf(scan.id).service != service;
  });
}

// To free a large map takes longer than to answer a scan. Sessions let it go with their next scans.
void TeamAtlas::Tidy() {
  decltype(retired_) retired;
  decltype(outdated_) let_go;
  const std::lock_guard lock(extension_);
  retired.swap(retired_);
  const auto unused = std::ranges::partition(
      outdated_, [](const std::shared_ptr<TeamMap>& map) { return map.use_count() > 1; });
  let_go.assign(std::make_move_iterator(unused.begin()), std::make_move_iterator(unused.end()));
  outdated_.erase(unused.begin(), unused.end());
}

void TeamAtlas::RepeatEpoch() {
  const std::lock_guard lock(extension_);
  if (epoch_.number == 0) return;
  TeamEpoch epoch = EpochOf(maps_, AsTheyAre(maps_), epoch_);
  if (!IsTeams()) LeaveOutComponents(epoch);
  surroundings_.sinks.Tell(&TeamSink::TakeEpoch, epoch);
}

void TeamAtlas::Tell(TeamEpoch epoch) {
  if (!IsTeams()) LeaveOutComponents(epoch);
  TellAsEvent(epoch);
  std::map<ScanKey, const MovedScan*> moved;
  for (const MovedScan& scan : epoch.scans) moved[scan.key] = &scan;
  for (TeamScan& scan : of_others_) {
    const auto there = moved.find(scan.key);
    if (there == moved.end()) continue;
    scan.component = there->second->component;
    scan.map_robot = there->second->map_robot;
  }
  const auto shared = std::make_shared<const TeamEpoch>(std::move(epoch));
  surroundings_.keep(ToJournal(*shared),
                     [this, shared] { surroundings_.sinks.Tell(&TeamSink::TakeEpoch, *shared); });
}

void TeamAtlas::TellAsEvent(const TeamEpoch& epoch) const {
  double farthest_m = 0.0;
  std::set<std::pair<std::string, std::string>> moves;
  for (const MovedScan& scan : epoch.scans) {
    if (scan.component != scan.component_before) {
      moves.emplace(scan.component_before, scan.component);
      continue;
    }
    const Eigen::Vector2d moved_m =
        scan.map_robot.T_a_b.translation_m() - scan.T_map_robot_before.translation_m();
    farthest_m = std::max(farthest_m, moved_m.norm());
  }
  const std::string by =
      epoch.rank.service == surroundings_.service() ? "" : " by " + epoch.rank.service;
  const auto tell = [this](const std::string& text) {
    surroundings_.sinks.Tell(&TeamSink::TakeEvent,
                             {.robot = std::nullopt, .is_warning = false, .text = text});
  };
  for (const auto& [from, into] : moves) {
    tell(fmt::format(
        "{} was found in {}{}: its scans are there now", FrameOf(from), FrameOf(into), by));
  }
  if (moves.empty() || farthest_m > 0.0) {
    tell(fmt::format("the map was corrected{}: its scans move by up to {:.2f} m", by, farthest_m));
  }
}

TeamCorrector& TeamAtlas::CorrectorOf(const std::string& component) {
  return correctors_.try_emplace(component, options_.mapper).first->second;
}

void TeamAtlas::TellNewPoints(const TeamScan& scan, const MapAddition& addition) const {
  std::vector<Eigen::Vector2d> points_map_m;
  points_map_m.reserve(addition.points.size());
  for (const MapPoint& point : addition.points) points_map_m.push_back(point.p_map_m);
  surroundings_.sinks.Tell(&TeamSink::TakeNewPoints,
                           {.robot = scan.key.robot,
                            .component = scan.component,
                            .stamp = scan.scan.stamp,
                            .points_map_m = points_map_m});
}

}  // namespace qwsm::team
