// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_merger.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace qwsm::team {
namespace {

// A map that has grown by no more than this is searched as it was.
constexpr double kGrown = 1.1;

// A robot that was told where it is is judged by this many of its scans, and twice as many, if
// these do not tell.
constexpr std::size_t kScansToJudge = 5;

// That two maps look alike is known by then. Wrong once in a hundred places that do.
constexpr double kSureNats = 4.6;
// Who was told where it is is taken out of the map only where that is beyond doubt: once in ten
// thousand millions. Maps of robots that drift contradict each other a little, too.
constexpr double kRefutedNats = -23.0;

ComponentPlace TheOtherWayRound(const ComponentPlace& place) {
  return {.from = place.into,
          .from_name = place.into_name,
          .into = place.from,
          .into_name = place.from_name,
          .into_from = Inverse(place.into_from)};
}

}  // namespace

MapMerger::MapMerger(const MapperOptions& options)
    : options_(options), agreement_(options.locator, options.free_space) {}

void MapMerger::See(std::string_view robot, Sighting sighting) {
  const std::lock_guard lock(mutex_);
  sightings_.insert_or_assign(std::string(robot), std::move(sighting));
}

std::optional<ComponentPlace> MapMerger::LookAround(const std::vector<MapComponent>& components,
                                                    const std::stop_token& stop) {
  ForgetWhatIsNone(components);
  if (components.size() < 2) return std::nullopt;
  for (const auto& [robot, sighting] : NewestSightings()) {
    for (const MapComponent& other : components) {
      if (stop.stop_requested()) return std::nullopt;
      if (other.map == sighting.component.map) continue;
      if (const auto found = LookFor(robot, sighting, other)) return found;
    }
  }
  return std::nullopt;
}

std::optional<ComponentPlace> MapMerger::LookFor(const std::string& robot,
                                                 const Sighting& sighting,
                                                 const MapComponent& other) {
  const Chart& into = ChartOf(other);
  const auto [known, is_new] = searches_.try_emplace(
      {robot, other.name}, Search{sighting.version, into.version, PlaceFinder(options_)});
  Search& search = known->second;
  if (search.from != sighting.version || search.into != into.version) {
    search = {sighting.version, into.version, PlaceFinder(options_)};
  }
  const std::optional<Pose2> T_from_looked = search.finder.T_local_looked();
  const PlaceBelief& belief =
      search.finder.Look(into.map, sighting.points, sighting.map_robot.T_a_b);
  const bool has_looked = search.finder.T_local_looked() != T_from_looked;
  if (!has_looked || belief.verdict != PlaceVerdict::kFound) return std::nullopt;
  const UncertainPose2 robot_from{.T_a_b = sighting.map_robot.T_a_b.Inverse()};
  ComponentPlace place{.from = sighting.version,
                       .from_name = sighting.component.name,
                       .into = into.version,
                       .into_name = other.name,
                       .into_from = belief.places.front().map_robot * robot_from};
  const MapAgreement::Judgement judged =
      agreement_.Judge(into.map, ChartOf(sighting.component).map, place.into_from);
  if (judged.nats < kSureNats) return std::nullopt;
  place.into_from = judged.a_b;
  return place.into_name < place.from_name ? place : TheOtherWayRound(place);
}

void MapMerger::HearPlaceOf(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  told_.insert_or_assign(std::string(robot), kScansToJudge);
}

bool MapMerger::IsPlaceOpen(std::string_view robot) const {
  const std::lock_guard lock(mutex_);
  return told_.contains(robot);
}

std::optional<MisplacedRobot> MapMerger::FindMisplaced(
    const std::vector<MapComponent>& components) {
  for (const auto& [robot, scans_to_judge] : Told()) {
    for (const MapComponent& component : components) {
      const std::size_t scans_of_robot = component.map->CountOf(robot);
      if (scans_of_robot < scans_to_judge) continue;
      const MapVersion version = component.map->version();
      const double nats = NatsOfPlace(component.map->Scans(), robot);
      const std::lock_guard lock(mutex_);
      const bool is_refuted = nats < kRefutedNats;
      if (is_refuted || nats > kSureNats) {
        told_.erase(robot);
      } else {
        told_[robot] = 2 * scans_of_robot;
      }
      if (is_refuted) return MisplacedRobot{robot, component.name, version};
    }
  }
  return std::nullopt;
}

// Of the place that a robot was told: whether its scans go together with those of the robots that
// were in the map before it.
double MapMerger::NatsOfPlace(const std::vector<TeamScan>& scans, const std::string& robot) const {
  std::set<std::string> elders;
  for (const TeamScan& scan : scans) {
    if (scan.key.robot == robot) break;
    elders.insert(scan.key.robot);
  }
  ScanMap of_robot(options_.map);
  ScanMap of_elders(options_.map);
  for (const TeamScan& scan : scans) {
    const bool is_of_robot = scan.key.robot == robot;
    if (!is_of_robot && !elders.contains(scan.key.robot)) continue;
    (is_of_robot ? of_robot : of_elders).Insert(scan.scan, ToPoints(scan.scan), scan.map_robot);
  }
  return agreement_.Judge(of_elders, of_robot, {}).nats;
}

std::map<std::string, std::size_t> MapMerger::Told() const {
  const std::lock_guard lock(mutex_);
  return {told_.begin(), told_.end()};
}

std::map<std::string, Sighting> MapMerger::NewestSightings() const {
  const std::lock_guard lock(mutex_);
  return {sightings_.begin(), sightings_.end()};
}

const MapMerger::Chart& MapMerger::ChartOf(const MapComponent& component) {
  const TeamMap::State::View contents = component.map->Read();
  const MapVersion version = component.map->VersionOf(*contents);
  Chart& chart = charts_[component.name];
  const auto size = static_cast<double>(contents->map.scans().size());
  const bool has_grown = size > kGrown * static_cast<double>(chart.map.scans().size());
  if (has_grown || chart.version != version) {
    chart.version = version;
    chart.map = contents->map;
  }
  return chart;
}

void MapMerger::ForgetWhatIsNone(const std::vector<MapComponent>& components) {
  const auto is_one = [&](const std::string& name) {
    return components.size() > 1 &&
           std::ranges::find(components, name, &MapComponent::name) != components.end();
  };
  std::erase_if(charts_, [&](const auto& chart) { return !is_one(chart.first); });
  std::erase_if(searches_, [&](const auto& search) { return !is_one(search.first.second); });
  const std::lock_guard lock(mutex_);
  std::erase_if(sightings_, [&](const auto& seen) {
    const MapComponent& component = seen.second.component;
    return !is_one(component.name) ||
           std::ranges::none_of(components, [&](const MapComponent& one) {
             return one.name == component.name && one.map == component.map;
           });
  });
}

}  // namespace qwsm::team
