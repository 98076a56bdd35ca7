// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/rearranged_maps.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace qwsm::team {
namespace {

bool IsSame(const Placement& a, const Placement& b) {
  return a.component == b.component && a.map_robot.T_a_b == b.map_robot.T_a_b;
}

// Visits the scans from that one on that are to be placed, few at a time: who adds scans is not to
// wait until all are copied.
template <class Visit>
void ForEachScan(const MapComponent& component,
                 std::size_t first,
                 std::span<const Placement> places,
                 Visit visit) {
  constexpr std::size_t kAtATime = 16;
  while (first < places.size()) {
    const std::size_t count = std::min(kAtATime, places.size() - first);
    for (TeamScan& scan : component.map->Scans(static_cast<ScanId>(first), count)) {
      visit(std::move(scan), places[first++]);
    }
  }
}

void Put(TeamScan scan, const Placement& place, TeamMap& map) {
  if (map.Find(scan.key)) return;
  scan.map_robot = place.map_robot;
  map.Insert(scan, ToPoints(scan.scan));
}

}  // namespace

// First those that stay in their component, then those that come to it: each in their order.
void RearrangedMaps::Follow(const TeamMaps& maps, const Rearrangement& rearrangement) {
  if (Fates fates = FatesOf(maps, rearrangement); fates != fates_) Begin(maps, std::move(fates));
  std::vector<std::pair<TeamScan, const Placement*>> arriving;
  for (const MapComponent& component : maps.All()) {
    const auto wanted = rearrangement.wanted.find(component.name);
    if (wanted == rearrangement.wanted.end()) continue;
    const std::size_t first = std::exchange(placed_[component.name], wanted->second.size());
    const auto made = made_.find(component.name);
    if (made == made_.end()) continue;  // Its scans are where they belong.
    ForEachScan(component, first, wanted->second, [&](TeamScan scan, const Placement& place) {
      if (place.component == component.name) {
        Put(std::move(scan), place, *made->second);
      } else {
        arriving.emplace_back(std::move(scan), &place);
      }
    });
  }
  for (auto& [scan, place] : arriving) Put(std::move(scan), *place, *made_.at(place->component));
}

std::map<std::string, std::shared_ptr<TeamMap>> RearrangedMaps::maps() const {
  auto maps = made_;
  for (auto& [name, map] : maps) {
    if (map->Read()->map.scans().empty()) map.reset();
  }
  return maps;
}

RearrangedMaps::Fates RearrangedMaps::FatesOf(const TeamMaps& maps,
                                              const Rearrangement& rearrangement) {
  Fates fates;
  const auto note = [&fates](const std::string& component, Fate fate) {
    Fate& known = fates.try_emplace(component, fate).first->second;
    // Where some arrive while others move, those that came meanwhile would get other ids.
    known = known == fate ? fate : Fate::kIsMadeAnew;
  };
  for (const MapComponent& component : maps.All()) {
    const auto wanted = rearrangement.wanted.find(component.name);
    if (wanted == rearrangement.wanted.end()) continue;
    const TeamMap::State::View contents = component.map->Read();
    for (std::size_t id = 0; id < wanted->second.size(); ++id) {
      const Placement& place = wanted->second[id];
      const Placement now{.component = component.name,
                          .map_robot = contents->map.scans()[id].map_robot};
      if (IsSame(place, now)) continue;
      if (place.component == component.name) {
        note(component.name, Fate::kIsCorrected);
      } else {
        note(component.name, Fate::kIsMadeAnew);
        note(place.component, maps.Has(place.component) ? Fate::kGrows : Fate::kIsMadeAnew);
      }
    }
  }
  return fates;
}

void RearrangedMaps::Begin(const TeamMaps& maps, Fates fates) {
  placed_.clear();
  made_.clear();
  for (const MapComponent& component : maps.All()) {
    const auto fate = fates.find(component.name);
    if (fate == fates.end()) continue;
    if (fate->second == Fate::kGrows) {
      made_[component.name] = std::make_shared<TeamMap>(*component.map);
    } else if (fate->second == Fate::kIsCorrected) {
      made_[component.name] = component.map->EmptyNextVersion();
    }
  }
  for (const auto& [name, fate] : fates) {
    if (fate == Fate::kIsMadeAnew) made_[name] = maps.Make();
  }
  fates_ = std::move(fates);
}

}  // namespace qwsm::team
