// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/team_maps.hpp"

namespace qwsm::team {

TeamMaps::TeamMaps(MapSharing sharing, const ScanMapOptions& options)
    : sharing_(sharing), options_(options) {
  if (sharing_ == MapSharing::kTeam) by_robot_[""] = std::make_shared<TeamMap>(options_);
}

std::shared_ptr<TeamMap> TeamMaps::Of(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<TeamMap>& map =
      by_robot_[sharing_ == MapSharing::kTeam ? std::string() : std::string(robot)];
  if (!map) map = std::make_shared<TeamMap>(options_);
  return map;
}

std::vector<TeamMaps::NamedMap> TeamMaps::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<NamedMap> maps;
  for (const auto& [robot, map] : by_robot_) maps.push_back({.robot = robot, .map = map});
  return maps;
}

}  // namespace qwsm::team
