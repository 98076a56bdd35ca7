// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/team_maps.hpp"

namespace qwsm::team {

TeamMaps::TeamMaps(MapSharing sharing, const ScanMapOptions& options)
    : sharing_(sharing), options_(options) {
  if (sharing_ == MapSharing::kTeam) MapNamed("");
}

std::string TeamMaps::NameOf(std::string_view robot) const {
  const std::lock_guard lock(mutex_);
  return HomeOf(robot);
}

MapComponent TeamMaps::Of(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  const std::string name = HomeOf(robot);
  return {.name = name, .map = MapNamed(name)};
}

MapComponent TeamMaps::Named(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return {.name = name, .map = MapNamed(name)};
}

bool TeamMaps::Has(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return by_name_.contains(name);
}

std::vector<MapComponent> TeamMaps::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<MapComponent> components;
  for (const auto& [name, map] : by_name_) components.push_back({.name = name, .map = map});
  return components;
}

MapComponent TeamMaps::BeginFor(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  const std::string name = NewName(robot);
  name_of_robot_[std::string(robot)] = name;
  return {.name = name, .map = MapNamed(name)};
}

void TeamMaps::Reserve(const std::string& name) {
  const std::lock_guard lock(mutex_);
  names_.insert(name);
}

void TeamMaps::Put(std::string_view robot, const std::string& name) {
  const std::lock_guard lock(mutex_);
  name_of_robot_[std::string(robot)] = name;
}

std::string TeamMaps::NewNameFor(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  return NewName(robot);
}

void TeamMaps::GiveBack(const std::string& name) {
  const std::lock_guard lock(mutex_);
  names_.erase(name);
}

// A robot may begin several components, one after the other.
std::string TeamMaps::NewName(std::string_view robot) {
  const std::string stem = robot.empty() ? std::string("robot") : std::string(robot);
  std::string name = stem;
  for (int number = 2; names_.contains(name); ++number) name = stem + "_" + std::to_string(number);
  names_.insert(name);
  return name;
}

void TeamMaps::Exchange(const std::map<std::string, std::shared_ptr<TeamMap>>& map_of_component,
                        const std::map<std::string, std::string>& home_of_robot) {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, map] : map_of_component) {
    names_.insert(name);
    map ? by_name_.insert_or_assign(name, map).second : by_name_.erase(name) > 0;
  }
  for (const auto& [robot, home] : home_of_robot) name_of_robot_[robot] = home;
  size_ = by_name_.size();
}

std::string TeamMaps::HomeOf(std::string_view robot) const {
  const auto known = name_of_robot_.find(robot);
  if (known != name_of_robot_.end()) return known->second;
  return sharing_ == MapSharing::kTeam ? std::string() : std::string(robot);
}

std::shared_ptr<TeamMap> TeamMaps::MapNamed(const std::string& name) {
  std::shared_ptr<TeamMap>& map = by_name_[name];
  if (!map) {
    map = std::make_shared<TeamMap>(options_);
    names_.insert(name);
    size_ = by_name_.size();
  }
  return map;
}

}  // namespace qwsm::team
