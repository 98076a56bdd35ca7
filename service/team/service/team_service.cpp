// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/team_service.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "service/io/journal/scan_codec.hpp"
#include "service/team/journal/journaled_map.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// Maps are painted this often, however seldom they are told: little is left to do at the end.
constexpr std::chrono::duration<double> kPaintPeriod{0.2};
// Robots that are in a component of their own look around for another one this often.
constexpr std::chrono::duration<double> kMergePeriod{0.2};

// A map that does not change is told again for readers that do not ask for what was before them.
constexpr std::chrono::seconds kMapRepetition{10};

TeamServiceOptions WithQuadtree(TeamServiceOptions options) {
  options.mapper.matcher = MatcherKind::kQWsm;
  return options;
}

UncertainPose2 PlanarStart(const RobotStartOptions& robot) {
  return UncertainPose2::WithSigmas(
      {robot.x_m, robot.y_m, NormalizeAngle(robot.heading_rad)}, robot.sigma_m, robot.sigma_rad);
}

}  // namespace

TeamService::TeamService(const TeamServiceOptions& options,
                         SinkList<TeamSink> sinks,
                         const std::filesystem::path& journal)
    : options_(WithQuadtree(options)),
      sinks_(std::move(sinks)),
      atlas_(
          {.sharing = options_.team.map, .mapper = options_.mapper, .corrects = options_.corrects},
          {.service = [this] { return host_.identity(); },
           .keep = [this](io::JournalEntry entry,
                          std::function<void()> settled) { Keep(std::move(entry), settled); },
           .sinks = sinks_}),
      merger_(options_.mapper),
      host_(
          options_.team,
          {.file = journal, .kind = io::kScanJournal},
          [this](const TeamEvent& event) { sinks_.Tell(&TeamSink::TakeEvent, event); },
          [this](std::string robot) { return MakeSession(std::move(robot)); }) {
  JournaledMap map;
  host_.Restore([&](const io::JournalEntry& entry) { map.Take(entry); });
  atlas_.GoOnFrom(map.last_epoch());
  for (auto& [scan, component] : map.TakeScans()) {
    atlas_.Restore(scan, component);
    scan.component = component;
    offered_.push_back(std::move(scan));
  }
  host_.ExpectRobots();
}

TeamService::~TeamService() { Stop(); }

void TeamService::Start() {
  for (const TeamScan& scan : offered_) sinks_.Tell(&TeamSink::TakeRelevantScan, scan);
  offered_ = {};
  atlas_.RepeatEpoch();
  host_.Start({.tell_status = [this] { sinks_.Tell(&TeamSink::TakeStatus, Status()); },
               .tell_maps = [this](const std::stop_token& stop) { PaintMaps(stop); },
               .map_period = kPaintPeriod});
  if (options_.team.map != MapSharing::kTeam || !options_.merges_beside) return;
  merging_ = std::make_unique<PeriodicTask>(
      kMergePeriod, true, [this](const std::stop_token& stop) { MergeMaps(stop); });
}

void TeamService::Stop() {
  merging_.reset();
  epochs_.Stop();
  host_.Stop();
}

// The thread beside gives way to all others: nobody is to wait for it.
void TeamService::WaitUntilIdle() {
  epochs_.WaitUntilIdle();
  host_.WaitUntilIdle();
  if (options_.team.map == MapSharing::kTeam && !merging_) MergeMaps({});
}

// In the background, however long it takes.
void TeamService::MergeMaps(const std::stop_token& stop) {
  atlas_.Tidy();
  if (const auto place = merger_.LookAround(atlas_.maps().All(), stop)) Join(*place);
  if (const auto misplaced = merger_.FindMisplaced(atlas_.maps().All(), stop)) {
    const auto& [robot, component, version] = *misplaced;
    if (!atlas_.Part(robot, version, component)) return merger_.HearPlaceOf(robot);
    sinks_.Tell(&TeamSink::TakeEvent,
                {.robot = robot,
                 .is_warning = true,
                 .text = "is not where it was told: what it sees there, others do not"});
  }
}

// Places may look alike in all that was seen so far: who was found is judged like who was told.
void TeamService::Join(const ComponentPlace& place) {
  const std::vector<std::string> found = atlas_.maps().Named(place.from_name).map->Robots();
  if (!atlas_.Join(place)) return;
  for (const std::string& robot : found) merger_.HearPlaceOf(robot);
}

void TeamService::TakeIn(std::vector<TeamScan> scans) {
  std::ranges::sort(
      scans, {}, [](const TeamScan& scan) { return std::tie(scan.scan.stamp, scan.key); });
  for (TeamScan& scan : scans) TakeInOne(std::move(scan));
}

void TeamService::TakeInOne(TeamScan scan) {
  if (!ObjectionTo(scan).empty()) {
    ++refused_;
    return;
  }
  const std::string robot = scan.key.robot;
  if (!atlas_.TakeIn(std::move(scan))) {
    ++duplicates_;
    return;
  }
  ++taken_in_;
  const std::shared_ptr<TeamMap> map = atlas_.maps().Of(robot).map;
  if (const std::optional<TeamScan> last = map->LastOf(robot)) {
    map->robots().Report(robot, last->map_robot.T_a_b.translation_m(), steady_clock::now());
  }
}

void TeamService::OfferTakenIn() {
  for (const TeamScan& scan : atlas_.TakenIn()) {
    sinks_.Tell(&TeamSink::TakeRelevantScan, scan);
  }
}

void TeamService::Keep(io::JournalEntry entry, const std::function<void()>& settled) {
  if (!host_.journal()) return settled();
  host_.journal().Append(std::move(entry), settled);
}

TeamStatus TeamService::Status() const {
  TeamStatus status = host_.Status(StatusOfMaps());
  if (options_.team.map != MapSharing::kTeam) return status;
  for (RobotStatus& robot : status.robots) robot.component = atlas_.maps().NameOf(robot.name);
  return status;
}

MapStatus TeamService::StatusOfMaps() const {
  MapStatus status{
      .taken_in = taken_in_.load(), .duplicates = duplicates_.load(), .refused = refused_.load()};
  for (const MapComponent& component : atlas_.maps().All()) {
    const TeamMap::State::View contents = component.map->Read();
    status.scans += contents->map.scans().size();
    status.points += contents->map.surfaces().quadtree().size();
    status.corrections += contents->epoch;
  }
  return status;
}

// The thread of this gives way to all others: who waits for it to stop waits for them, too.
void TeamService::PaintMaps(const std::stop_token& stop) {
  const auto now = steady_clock::now();
  const auto is_time = [now](steady_clock::time_point& last, std::chrono::duration<double> period) {
    const bool is_due = now - last >= period;
    if (is_due) last = now;
    return is_due;
  };
  const bool is_time_to_tell =
      is_time(maps_told_, std::chrono::duration<double>(options_.team.map_period_s));
  const bool is_time_to_repeat = is_time_to_tell && is_time(maps_repeated_, kMapRepetition);
  const std::vector<MapComponent> components = atlas_.maps().All();
  std::erase_if(painters_, [&](const auto& painter) {
    return std::ranges::find(components, painter.first, &MapComponent::map) == components.end();
  });
  for (const MapComponent& component : components) {
    MapPainter& painter = PainterOf(component.map);
    painter.Paint(*component.map, stop);
    if (stop.stop_requested()) return;
    if (is_time_to_repeat || (is_time_to_tell && painter.has_news())) {
      TellMap(component.name, painter);
    }
  }
}

void TeamService::TellMap(const std::string& component, MapPainter& painter) {
  const std::optional<OccupancyGrid> grid = painter.Grid();
  std::string trouble = painter.trouble();
  try {
    if (grid) {
      sinks_.Tell(&TeamSink::TakeMap,
                  {.component = component,
                   .frame = FrameOf(options_.team.map == MapSharing::kTeam ? component : ""),
                   .stamp = painter.newest(),
                   .grid = *grid});
    }
  } catch (const std::runtime_error& error) {
    trouble = std::string("the map cannot be told: ") + error.what();
  }
  if (trouble.empty()) return;
  const std::string text = FrameOf(component) + ": " + trouble;
  sinks_.Tell(&TeamSink::TakeEvent, {.robot = std::nullopt, .is_warning = true, .text = text});
}

std::optional<OccupancyGrid> TeamService::DrawMapOf(std::string_view robot) {
  const std::shared_ptr<const TeamMap> map = MapOf(robot);
  MapPainter& painter = PainterOf(map);
  painter.Paint(*map, {});
  return painter.Grid();
}

MapPainter& TeamService::PainterOf(const std::shared_ptr<const TeamMap>& map) {
  return painters_.try_emplace(map, options_.rendering).first->second;
}

std::shared_ptr<RobotSession> TeamService::MakeSession(std::string robot) {
  const auto report = [this](const RobotAnswer& answer) {
    host_.journal().TellWhenSafe([this, answer] { sinks_.Tell(&TeamSink::TakeReport, answer); });
  };
  const RobotStartOptions* const start = FindStart(options_.team, robot);
  SessionContext context{.service = identity(),
                         .atlas = atlas_,
                         .merger = merger_,
                         .sinks = sinks_,
                         .start = start ? std::optional(PlanarStart(*start)) : std::nullopt,
                         .teammate_radius_m = options_.team.teammate_radius_m,
                         .correction = CorrectionOf(options_.team.correction, robot),
                         .report = report};
  return std::make_shared<RobotSession>(
      std::move(robot), options_.team.session, options_.mapper, std::move(context));
}

}  // namespace qwsm::team
