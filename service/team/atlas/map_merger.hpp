// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/place_finder.hpp"
#include "qwsm/sensor/scan_points.hpp"
#include "service/team/atlas/joint_candidates.hpp"
#include "service/team/atlas/map_agreement.hpp"
#include "service/team/atlas/team_atlas.hpp"
#include "service/team/atlas/teammate_sight.hpp"

namespace qwsm::team {

/// What a robot sees, and where it is in the component that it is in.
struct Sighting {
  MapComponent component;
  MapVersion version;  ///< Of the component's map that the pose is in.
  std::vector<ScanPoint> points;
  UncertainPose2 map_robot;
};

/// A robot that is not where it was told.
struct MisplacedRobot {
  std::string robot;
  std::string component;  ///< That it is in, wrongly.
  MapVersion version;
};

/// Finds where the components of a team's map lie in one another: a robot of one of them drives
/// where another one is mapped, recognises one place after the other, and all that both have mapped
/// goes together. Works beside the robots, on copies of the maps, with what each saw last.
class MapMerger {
 public:
  explicit MapMerger(const MapperOptions& options);

  /// Takes what a robot sees. May be called from any thread.
  void See(std::string_view robot, Sighting sighting);
  /// Takes that a robot is where somebody says. May be called from any thread.
  void HearPlaceOf(std::string_view robot);
  /// Whether a robot is where somebody says, and nothing has confirmed that yet. May be called from
  /// any thread.
  bool IsPlaceOpen(std::string_view robot) const;

  /// Looks whether robots that were told where they are have mapped there what those have that were
  /// in the map before.
  /// @return the first one that has not: that is somewhere else; none once it is stopped.
  std::optional<MisplacedRobot> FindMisplaced(const std::vector<MapComponent>& components,
                                              const std::stop_token& stop);

  /// Looks around with what was seen last by each robot, in all components but its own.
  /// @return the first place found where one component lies in another; none once it is stopped.
  std::optional<ComponentPlace> LookAround(const std::vector<MapComponent>& components,
                                           const std::stop_token& stop);

 private:
  // A copy of a component's map as it was, and who drew it.
  struct Chart {
    std::string component;
    MapVersion version;
    ScanMap map;
    std::vector<std::vector<ScanId>> scans_of_robots;
    MappedArea area;  // For all searches in it.

    DrawnMap Drawn() const { return {.map = map, .scans_of_robots = scans_of_robots}; }
  };
  // A robot's search for its place in another component than its own.
  struct Search {
    MapVersion from;
    MapVersion into;
    PlaceFinder finder;
  };

  using Sightings = std::map<std::string, Sighting, std::less<>>;  // By robot.

  Sightings NewestSightings() const;
  std::map<std::string, std::size_t> Told() const;
  double NatsOfPlace(const std::vector<TeamScan>& scans,
                     const std::string& robot,
                     const std::stop_token& stop) const;
  Chart& ChartOf(const MapComponent& component);
  std::optional<ComponentPlace> LookFor(const std::string& robot,
                                        const Sighting& sighting,
                                        const MapComponent& other,
                                        const std::stop_token& stop);
  std::vector<DrawnMap> ChartsBeside(const Chart& one, const Chart& other) const;
  Search& SearchBy(const std::string& robot,
                   const Sighting& sighting,
                   const MapComponent& other,
                   const Chart& chart);
  void ForgetWhatIsNone(const std::vector<MapComponent>& components);

  const MapperOptions options_;
  const MapAgreement agreement_;
  mutable std::mutex mutex_;
  Sightings sightings_;
  // Robots that were told where they are, and how many scans they had when that was looked at.
  std::map<std::string, std::size_t, std::less<>> told_;

  // Whoever looks around alone uses these.
  std::map<std::string, Chart> charts_;                             // By component.
  std::map<std::pair<std::string, std::string>, Search> searches_;  // By robot and component.
  // By the component that another one may lie in, and that one: the lesser name first.
  std::map<std::pair<std::string, std::string>, JointCandidates> candidates_;
};

}  // namespace qwsm::team
