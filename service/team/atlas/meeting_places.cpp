// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/meeting_places.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "qwsm/mapping/place_finder.hpp"
#include "qwsm/sensor/scan_points.hpp"
#include "service/team/atlas/joint_candidates.hpp"
#include "service/team/atlas/map_agreement.hpp"
#include "service/team/atlas/teammate_sight.hpp"

namespace qwsm::team {
namespace {

/// A map of which it is not known where it lies.
struct Apart {
  std::size_t map = 0;
  JointCandidates candidates{};        // Where it may.
  std::size_t places_looked_into = 0;  // Of those known.
};

/// A map that one robot drew, which adds scans in the order of time.
class OwnMap {
 public:
  explicit OwnMap(const ScanMap& map) : map_(map), scans_of_robots_(1) {
    scans_of_robots_.front().resize(map.scans().size());
    std::iota(scans_of_robots_.front().begin(), scans_of_robots_.front().end(), ScanId{0});
  }

  const ScanMap& map() const { return map_; }
  DrawnMap Drawn() const { return {.map = map_, .scans_of_robots = scans_of_robots_}; }

 private:
  const ScanMap& map_;
  std::vector<std::vector<ScanId>> scans_of_robots_;
};

/// The maps that have a place, and the search for the others'.
class MeetingSearch {
 public:
  /// @param first the map that the others are placed in.
  MeetingSearch(std::span<const ScanMap* const> maps,
                std::size_t first,
                const MapperOptions& options,
                const std::function<bool()>& stop)
      : options_(options),
        stop_(stop),
        agreement_(options.locator, options.free_space),
        met_{.places = {MeetingPlace{.map = first, .first_map = {}}}, .map = *maps[first]} {
    for (const ScanMap* map : maps) maps_.emplace_back(*map);
    scans_of_met_.push_back(maps_[first].Drawn().scans_of_robots.front());
  }

  /// Gives a place to that of the maps for whose place most speaks: those that might be there in
  /// its stead are judged with it.
  /// @return whether one has got a place.
  bool JoinOne(std::vector<Apart>& apart) {
    auto best = apart.end();
    std::optional<Joint> best_joint;
    for (auto one = apart.begin(); one != apart.end(); ++one) {
      const std::optional<Joint> joint = FindPlace(*one);
      if (stop_()) return false;
      if (!joint || (best_joint && joint->nats <= best_joint->nats)) continue;
      best = one;
      best_joint = joint;
    }
    if (!best_joint) return false;
    Insert(best->map, best_joint->a_b);
    apart.erase(best);
    return true;
  }

  MetMaps Take() && { return std::move(met_); }

 private:
  // By what was thought of it before, now that the maps have grown; then by looking around in maps
  // that have got a place since that was done last.
  std::optional<Joint> FindPlace(Apart& apart) const {
    std::optional<Joint> joint = Decide(apart);
    while (!joint && apart.places_looked_into < met_.places.size()) {
      joint = LookInto(met_.places[apart.places_looked_into], apart);
      if (!joint)
        ++apart.places_looked_into;  // Else not all of it, and another map may come first.
    }
    return joint;
  }

  // As soon as the robot by itself would think that it is found, all that both have mapped is
  // asked; and in the end.
  std::optional<Joint> LookInto(const MeetingPlace& other, Apart& apart) const {
    PlaceFinder finder(options_);
    for (const RelevantScan& scan : maps_[apart.map].map().scans()) {
      if (stop_()) return std::nullopt;
      const Pose2& T_own_robot = scan.map_robot.T_a_b;
      const std::optional<Pose2> T_own_looked = finder.T_local_looked();
      const PlaceBelief& belief =
          finder.Look(maps_[other.map].map(), ToPoints(scan.scan), T_own_robot);
      if (finder.T_local_looked() == T_own_looked) continue;
      Propose(belief, T_own_robot, other.first_map, apart.candidates);
      if (belief.verdict != PlaceVerdict::kFound) continue;
      if (const std::optional<Joint> joint = Decide(apart)) return joint;
      finder = PlaceFinder(options_);
    }
    return Decide(apart);
  }

  void Insert(std::size_t map, const UncertainPose2& first_map) {
    std::vector<ScanId>& scans_of_robot = scans_of_met_.emplace_back();
    for (const RelevantScan& scan : maps_[map].map().scans()) {
      scans_of_robot.push_back(met_.map.Insert(scan.scan, first_map * scan.map_robot));
    }
    met_.places.push_back({.map = map, .first_map = first_map});
  }

  static void Propose(const PlaceBelief& belief,
                      const Pose2& T_own_robot,
                      const UncertainPose2& first_map,
                      JointCandidates& candidates) {
    const UncertainPose2 robot_own = Inverse({.T_a_b = T_own_robot});
    for (const Place& place : belief.places) {
      if (place.probability < JointCandidates::kWorthALook) break;
      candidates.Propose(first_map * place.map_robot * robot_own, T_own_robot);
    }
  }

  std::optional<Joint> Decide(Apart& apart) const {
    return apart.candidates.Decide(agreement_,
                                   {.map = met_.map, .scans_of_robots = scans_of_met_},
                                   maps_[apart.map].Drawn(),
                                   OthersWithoutPlace(apart),
                                   {});
  }

  std::vector<DrawnMap> OthersWithoutPlace(const Apart& apart) const {
    std::vector<DrawnMap> others;
    for (std::size_t map = 0; map < maps_.size(); ++map) {
      const bool has_place =
          std::ranges::find(met_.places, map, &MeetingPlace::map) != met_.places.end();
      if (map != apart.map && !has_place) others.push_back(maps_[map].Drawn());
    }
    return others;
  }

  std::vector<OwnMap> maps_;
  const MapperOptions& options_;
  const std::function<bool()>& stop_;
  MapAgreement agreement_;
  MetMaps met_;
  std::vector<std::vector<ScanId>> scans_of_met_;  // Of each robot.
};

/// The first map that anything is in; the first one where there is none.
std::size_t FirstWithScans(std::span<const ScanMap* const> maps) {
  const auto first = std::ranges::find_if(maps, [](const ScanMap* map) { return !map->empty(); });
  return first == maps.end() ? 0 : static_cast<std::size_t>(first - maps.begin());
}

}  // namespace

MetMaps FindMeetingPlaces(std::span<const ScanMap* const> maps,
                          const MapperOptions& options,
                          const std::function<bool()>& stop) {
  if (maps.empty()) return {.places = {}, .map = ScanMap()};
  const std::size_t first = FirstWithScans(maps);
  MeetingSearch search(maps, first, options, stop);
  std::vector<Apart> apart;
  for (std::size_t map = 0; map < maps.size(); ++map) {
    if (map != first) apart.push_back({.map = map});
  }
  while (search.JoinOne(apart)) {
  }
  return std::move(search).Take();
}

}  // namespace qwsm::team
