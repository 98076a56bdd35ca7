// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/rearrangement.hpp"

#include <algorithm>

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm::team {
namespace {

// Follows what was told of one component, scan by scan in their order.
class Follower {
 public:
  Follower(const MapComponent& component, const Placements& told)
      : component_(component), told_(told), contents_(component.map->Read()) {}

  std::vector<Placement> Follow(bool& moves_others) {
    std::vector<Placement> wanted;
    for (const RelevantScan& scan : contents_->map.scans()) {
      wanted.push_back(Of(scan, wanted));
      const bool is_told = last_told_[component_.map->KeyOf(scan.id).robot] == scan.id;
      const Placement& place = wanted.back();
      const bool moves =
          place.component != component_.name || !(place.map_robot.T_a_b == scan.map_robot.T_a_b);
      moves_others = moves_others || (moves && !is_told);
    }
    return wanted;
  }

 private:
  Placement Of(const RelevantScan& scan, const std::vector<Placement>& wanted) {
    const ScanKey key = component_.map->KeyOf(scan.id);
    std::optional<ScanId>& last_told = last_told_[key.robot];
    if (const auto told = told_.find(key); told != told_.end()) {
      last_told = scan.id;
      return told->second;
    }
    const Placement stays{.component = component_.name, .map_robot = scan.map_robot};
    if (!last_told) return stays;
    const UncertainPose2& before = contents_->map.scans()[*last_told].map_robot;
    const Placement& after = wanted[*last_told];
    if (after.component == component_.name && after.map_robot.T_a_b == before.T_a_b) return stays;
    return {.component = after.component,
            .map_robot = after.map_robot * Since(before, scan.map_robot)};
  }

  const MapComponent& component_;
  const Placements& told_;
  TeamMap::State::View contents_;
  std::map<std::string, std::optional<ScanId>> last_told_;  // By robot.
};

}  // namespace

Rearrangement AsTheyAre(const TeamMaps& maps) { return Follow(maps, {}); }

Rearrangement Follow(const TeamMaps& maps, const Placements& told) {
  Rearrangement followed;
  for (const MapComponent& component : maps.All()) {
    followed.wanted[component.name] = Follower(component, told).Follow(followed.moves_others);
  }
  return followed;
}

TeamEpoch EpochOf(const TeamMaps& maps, const Rearrangement& wanted, const EpochRank& rank) {
  TeamEpoch epoch{.rank = rank, .stamp = {}, .scans = {}};
  for (const MapComponent& component : maps.All()) {
    const std::vector<Placement>& places = wanted.wanted.at(component.name);
    const TeamMap::State::View contents = component.map->Read();
    for (const RelevantScan& scan : contents->map.scans()) {
      epoch.stamp = std::max(epoch.stamp, scan.scan.stamp);
      epoch.scans.push_back({.key = component.map->KeyOf(scan.id),
                             .component = places[scan.id].component,
                             .component_before = component.name,
                             .T_map_robot_before = scan.map_robot.T_a_b,
                             .map_robot = places[scan.id].map_robot});
    }
  }
  return epoch;
}

}  // namespace qwsm::team
