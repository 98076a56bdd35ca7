// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/atlas/map_merger.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace qwsm::team {
namespace {

// A map that has grown by no more than this is searched as it was.
constexpr double kOutgrown = 1.1;

// A robot that was told where it is is judged by this many of its scans, and twice as many, if
// these do not tell.
constexpr std::size_t kScansToJudge = 5;

// Who was told where it is is there beyond doubt.
constexpr double kConfirmedNats = 4.6;
// Who was told where it is is taken out of the map only where that is beyond doubt: once in ten
// thousand millions. Maps of robots that drift contradict each other a little, too.
constexpr double kMisplacedNats = -23.0;

// What belongs to two components, in the order in which they become one: of the other one in that
// of the lesser name.
template <class Value>
std::pair<Value, Value> IntoAndFrom(const MapComponent& one,
                                    const Value& of_one,
                                    const MapComponent& other,
                                    const Value& of_other) {
  return one.name < other.name ? std::pair(of_one, of_other) : std::pair(of_other, of_one);
}

// Of each robot, in the order of time.
std::vector<std::vector<ScanId>> ScansOfRobots(const TeamMap& keys, const ScanMap& map) {
  std::map<std::string, std::vector<ScanId>> by_robot;
  for (const RelevantScan& scan : map.scans()) {
    by_robot[keys.KeyOf(scan.id).robot].push_back(scan.id);
  }
  std::vector<std::vector<ScanId>> scans_of_robots;
  for (auto& [robot, scans] : by_robot) {
    std::ranges::stable_sort(scans, {}, [&](ScanId id) { return map.scans()[id].scan.stamp; });
    scans_of_robots.push_back(std::move(scans));
  }
  return scans_of_robots;
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
      if (const auto found = LookFor(robot, sighting, other, stop)) return found;
    }
  }
  return std::nullopt;
}

std::optional<ComponentPlace> MapMerger::LookFor(const std::string& robot,
                                                 const Sighting& sighting,
                                                 const MapComponent& other,
                                                 const std::stop_token& stop) {
  const Chart& own = ChartOf(sighting.component);
  Chart& there = ChartOf(other);
  if (own.version != sighting.version) return std::nullopt;  // Corrected since.
  Search& search = SearchBy(robot, sighting, other, there);
  const std::optional<Pose2> T_own_looked = search.finder.T_local_looked();
  const PlaceBelief& belief =
      search.finder.Look(there.map, there.area, sighting.points, sighting.map_robot.T_a_b);
  if (search.finder.T_local_looked() == T_own_looked) return std::nullopt;

  JointCandidates& candidates = candidates_[std::minmax(sighting.component.name, other.name)];
  const UncertainPose2 own_robot{.T_a_b = sighting.map_robot.T_a_b};
  for (const Place& place : belief.places) {
    if (place.probability < JointCandidates::kWorthALook) break;
    const auto [into_robot, from_robot] =
        IntoAndFrom(sighting.component, own_robot, other, place.map_robot);
    candidates.Propose(into_robot * Inverse(from_robot), from_robot.T_a_b);
  }
  const auto [into, from] = IntoAndFrom(sighting.component, &own, other, &std::as_const(there));
  const std::optional<Joint> joint =
      candidates.Decide(agreement_, into->Drawn(), from->Drawn(), ChartsBeside(*into, *from), stop);
  if (!joint) return std::nullopt;
  return ComponentPlace{.from = from->version,
                        .from_name = from->component,
                        .into = into->version,
                        .into_name = into->component,
                        .into_from = joint->a_b};
}

std::vector<DrawnMap> MapMerger::ChartsBeside(const Chart& one, const Chart& other) const {
  std::vector<DrawnMap> beside;
  for (const auto& [name, chart] : charts_) {
    if (name != one.component && name != other.component) beside.push_back(chart.Drawn());
  }
  return beside;
}

MapMerger::Search& MapMerger::SearchBy(const std::string& robot,
                                       const Sighting& sighting,
                                       const MapComponent& other,
                                       const Chart& chart) {
  const auto [known, is_new] = searches_.try_emplace(
      {robot, other.name}, Search{sighting.version, chart.version, PlaceFinder(options_)});
  Search& search = known->second;
  if (search.from != sighting.version || search.into != chart.version) {
    search = {sighting.version, chart.version, PlaceFinder(options_)};
  }
  return search;
}

void MapMerger::HearPlaceOf(std::string_view robot) {
  const std::lock_guard lock(mutex_);
  told_.insert_or_assign(std::string(robot), kScansToJudge);
}

bool MapMerger::IsPlaceOpen(std::string_view robot) const {
  const std::lock_guard lock(mutex_);
  return told_.contains(robot);
}

std::optional<MisplacedRobot> MapMerger::FindMisplaced(const std::vector<MapComponent>& components,
                                                       const std::stop_token& stop) {
  for (const auto& [robot, scans_to_judge] : Told()) {
    for (const MapComponent& component : components) {
      const std::size_t scans_of_robot = component.map->CountOf(robot);
      if (scans_of_robot < scans_to_judge) continue;
      const MapVersion version = component.map->version();
      const double nats = NatsOfPlace(component.map->Scans(), robot, stop);
      if (stop.stop_requested()) return std::nullopt;
      const std::lock_guard lock(mutex_);
      const bool is_refuted = nats < kMisplacedNats;
      if (is_refuted || nats > kConfirmedNats) {
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
double MapMerger::NatsOfPlace(const std::vector<TeamScan>& scans,
                              const std::string& robot,
                              const std::stop_token& stop) const {
  std::set<std::string> elders;
  for (const TeamScan& scan : scans) {
    if (scan.key.robot == robot) break;
    elders.insert(scan.key.robot);
  }
  ScanMap of_robot(options_.map);
  ScanMap of_elders(options_.map);
  for (const TeamScan& scan : scans) {
    if (stop.stop_requested()) break;
    const bool is_of_robot = scan.key.robot == robot;
    if (!is_of_robot && !elders.contains(scan.key.robot)) continue;
    (is_of_robot ? of_robot : of_elders).Insert(scan.scan, scan.map_robot);
  }
  return agreement_.Judge(of_elders, of_robot, {}, stop).nats;
}

std::map<std::string, std::size_t> MapMerger::Told() const {
  const std::lock_guard lock(mutex_);
  return {told_.begin(), told_.end()};
}

MapMerger::Sightings MapMerger::NewestSightings() const {
  const std::lock_guard lock(mutex_);
  return sightings_;
}

MapMerger::Chart& MapMerger::ChartOf(const MapComponent& component) {
  const TeamMap::State::View contents = component.map->Read();
  const MapVersion version = component.map->VersionOf(*contents);
  Chart& chart = charts_[component.name];
  const auto size = static_cast<double>(contents->map.scans().size());
  const bool has_grown = size > kOutgrown * static_cast<double>(chart.map.scans().size());
  if (has_grown || chart.version != version) {
    chart.component = component.name;
    chart.version = version;
    chart.map = contents->map;
    chart.scans_of_robots = ScansOfRobots(*component.map, chart.map);
    chart.area = {};
  }
  return chart;
}

void MapMerger::ForgetWhatIsNone(const std::vector<MapComponent>& components) {
  const auto is_one = [&](const std::string& name) {
    return components.size() > 1 &&
           std::ranges::find(components, name, &MapComponent::name) != components.end();
  };
  std::erase_if(charts_, [&](const auto& chart) { return !is_one(chart.first); });
  std::erase_if(candidates_, [&](const auto& known) {
    return !is_one(known.first.first) || !is_one(known.first.second);
  });
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
