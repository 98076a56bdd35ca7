// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/map/map_sharing.hpp"
#include "service/team/map/team_map.hpp"

namespace qwsm::team {

/// The maps of a team: one for all robots, or one for each. All functions may be called from any
/// thread.
class TeamMaps {
 public:
  struct NamedMap {
    std::string robot;  ///< Whose map it is; empty for the team's.
    std::shared_ptr<TeamMap> map;
  };

  TeamMaps(MapSharing sharing, const ScanMapOptions& options);

  /// The map that the robot is matched against.
  std::shared_ptr<TeamMap> Of(std::string_view robot);
  std::vector<NamedMap> All() const;

 private:
  const MapSharing sharing_;
  const ScanMapOptions options_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<TeamMap>, std::less<>> by_robot_;
};

}  // namespace qwsm::team
