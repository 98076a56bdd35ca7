// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/team/map/robot_positions.hpp"
#include "service/team/map/twin_state.hpp"
#include "service/team/scans/map_version.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::team {

class TeamMap;

/// A map of a team: many robots match against it while others extend it, and none waits for
/// another. All functions may be called from any thread.
///
/// What is guaranteed about two maps that were given the same scans:
/// * They hold the same relevant scans, each once, whatever was repeated and in whatever order; so
///   the occupancy grids drawn of them are equal.
/// * In the same order they are equal bit for bit, down to the ids of points. That is how a map
///   comes back from the journal.
/// * In another order they may keep different points for the same surface: a point is not stored
///   where older scans have put enough (InsertionRule::kNewSurface), and the older scan is then
///   another one. With InsertionRule::kEveryPoint the points are the same in any order.
class TeamMap {
 public:
  /// What robots are matched against.
  struct Contents {
    ScanMap map;
    std::uint32_t epoch = 0;  ///< How often the map was corrected.
  };
  /// A scan that is added, or the map with all its scans where they belong.
  using Change = std::variant<MapAddition, std::shared_ptr<const ScanMap>>;
  using State = TwinState<Contents, Change>;

  explicit TeamMap(const ScanMapOptions& options = {});
  /// The same scans in the same places, of the same version: what is added to one of both changes
  /// neither where anything lies. Nobody is in it.
  TeamMap(const TeamMap& other);
  /// A map for the same scans in other places, in the same order, as the version after this one.
  std::shared_ptr<TeamMap> EmptyNextVersion() const;

  /// The map as it is now; see TwinState::View.
  State::View Read() const { return state_.Read(); }
  MapVersion VersionOf(const Contents& contents) const { return {number_, contents.epoch}; }
  MapVersion version() const { return VersionOf(*Read()); }

  /// A scan that was added.
  struct Insertion {
    ScanId id = 0;
    std::shared_ptr<const MapAddition> addition;
  };
  /// Adds a scan. @return nothing if the map knows the scan already.
  /// @param points the scan's points, as ToPoints() gives them. @pre ObjectionTo(scan).empty()
  std::optional<Insertion> Insert(const TeamScan& scan, std::span<const ScanPoint> points);

  /// Puts all its scans elsewhere. @param corrected the same scans in the same order.
  void Correct(ScanMap corrected);

  /// Where the robots that are matched against this map are at the moment.
  RobotPositions& robots() { return robots_; }

  /// Whether the caller, who does not know where its robot is, may be the one to begin the map
  /// there and so define its frame. True only for the first call.
  bool Begin() { return !has_begun_.exchange(true); }

  /// The last relevant scan of the robot: where it was and what its odometry said. Its ranges are
  /// left out.
  std::optional<TeamScan> LastOf(std::string_view robot) const;
  /// The robots of which it has relevant scans.
  std::vector<std::string> Robots() const;
  /// Number of relevant scans of the robot.
  std::size_t CountOf(std::string_view robot) const;
  /// The key of a scan. @pre it was added.
  ScanKey KeyOf(ScanId id) const;
  /// The scan of that key, if it was added.
  std::optional<ScanId> Find(const ScanKey& key) const;
  /// So many scans from that one on, or all, as they were added, each where it is now. Who adds one
  /// may have to wait for as long as it takes to copy them.
  std::vector<TeamScan> Scans(ScanId first = 0,
                              std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// The largest sequence number that the service gave a scan of the robot; 0 if it gave none.
  std::uint64_t LastSequence(std::string_view service, std::string_view robot) const;

 private:
  using Lock = std::scoped_lock<std::mutex, std::mutex>;

  TeamMap(const ScanMapOptions& options, const MapVersion& version);
  TeamMap(const TeamMap& other, const Lock& lock);

  struct ScansOfRobot {
    std::size_t count = 0;
    ScanId last = 0;
  };

  bool Register(const TeamScan& scan);
  TeamScan HeadOf(ScanId id) const;

  const std::uint64_t number_;
  State state_;
  RobotPositions robots_;
  std::atomic<bool> has_begun_ = false;
  mutable std::mutex insertion_;  // Gives a scan the same number in the map and in the register.
  mutable std::mutex register_;   // Guards what follows.
  std::unordered_map<ScanKey, ScanId, ScanKeyHash> id_of_;
  std::vector<TeamScan> heads_;  // Without their ranges, by ScanId.
  std::map<std::string, ScansOfRobot, std::less<>> by_robot_;
  std::map<std::pair<std::string, std::string>, std::uint64_t> last_sequence_;
};

}  // namespace qwsm::team
