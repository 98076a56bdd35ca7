// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/map/map_sharing.hpp"
#include "service/team/map/team_map.hpp"

namespace qwsm::team {

/// A map with a frame of its own: the one that the team shares, which has no name, or one of the
/// robots of which nobody knows where in it they are, named after the one that began it.
struct MapComponent {
  std::string name;
  std::shared_ptr<TeamMap> map;
};

/// The maps of a team, and which of them each robot is in. Where each robot has a map of its own it
/// is in a component from the start. All functions may be called from any thread.
class TeamMaps {
 public:
  TeamMaps(MapSharing sharing, const ScanMapOptions& options);

  MapSharing sharing() const { return sharing_; }

  /// Name of the component that the robot is in.
  std::string NameOf(std::string_view robot) const;
  /// The component that the robot is in.
  MapComponent Of(std::string_view robot);
  /// The component of that name; an empty one if there is none.
  MapComponent Named(const std::string& name);
  bool Has(const std::string& name) const;
  std::vector<MapComponent> All() const;
  /// Number of components, with the one that the team shares.
  std::size_t size() const { return size_.load(); }

  /// Begins a component of a name that none had before; the robot is in it from now on.
  MapComponent BeginFor(std::string_view robot);
  /// Says that a name was given before.
  void Reserve(const std::string& name);
  /// Says that the robot is in the component of that name from now on.
  void Put(std::string_view robot, const std::string& name);
  /// A name that no component had before, for one that the robot begins.
  std::string NewNameFor(std::string_view robot);
  /// Says that no component has got that name after all. @pre NewNameFor() gave it.
  void GiveBack(const std::string& name);
  /// An empty map, of no component yet.
  std::shared_ptr<TeamMap> Make() const { return std::make_shared<TeamMap>(options_); }
  /// Gives components other maps, all at once; one without a map is none any more. Who reads a map
  /// that was a component's may go on.
  /// @param home_of_robot names of the components that robots are in from now on.
  void Exchange(const std::map<std::string, std::shared_ptr<TeamMap>>& map_of_component,
                const std::map<std::string, std::string>& home_of_robot);

 private:
  std::string HomeOf(std::string_view robot) const;
  std::string NewName(std::string_view robot);
  std::shared_ptr<TeamMap> MapNamed(const std::string& name);

  const MapSharing sharing_;
  const ScanMapOptions options_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<TeamMap>> by_name_;
  std::map<std::string, std::string, std::less<>> name_of_robot_;
  std::set<std::string> names_;  // That were ever given.
  std::atomic<std::size_t> size_ = 0;
};

}  // namespace qwsm::team
