// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/team_service.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "service/io/journal/scan_codec.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// Maps are painted this often, however seldom they are told: little is left to do at the end.
constexpr std::chrono::duration<double> kPaintPeriod{0.2};

// A map that does not change is told again for readers that do not ask for what was before them.
constexpr std::chrono::seconds kMapRepetition{10};

TeamServiceOptions WithQuadtree(TeamServiceOptions options) {
  options.mapper.matcher = MatcherKind::kQWsm;
  return options;
}

io::JournalEntry ToJournal(const TeamScan& scan) {
  return {.service = scan.key.service,
          .robot = scan.key.robot,
          .sequence = scan.key.sequence,
          .stamp = scan.scan.stamp,
          .contents = io::EncodeScan({.relevant = {.scan = scan.scan, .map_robot = scan.map_robot},
                                      .T_odom_robot = scan.T_odom_robot})};
}

TeamScan ScanFromJournal(const io::JournalEntry& entry) {
  io::JournaledScan scan = io::DecodeScan(entry.contents);
  return {.key = {.service = entry.service, .robot = entry.robot, .sequence = entry.sequence},
          .scan = std::move(scan.relevant.scan),
          .map_robot = scan.relevant.map_robot,
          .T_odom_robot = scan.T_odom_robot};
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
      maps_(options.team.map, options.mapper.map),
      host_(
          options_.team,
          {.file = journal, .kind = io::kScanJournal},
          [this](const TeamEvent& event) { sinks_.Tell(&TeamSink::TakeEvent, event); },
          [this](std::string robot) { return MakeSession(std::move(robot)); }) {
  host_.Restore([this](const io::JournalEntry& entry) { Restore(ScanFromJournal(entry)); });
}

TeamService::~TeamService() { Stop(); }

void TeamService::Restore(TeamScan scan) {
  if (!maps_.Of(scan.key.robot)->Insert(scan, ToPoints(scan.scan))) return;
  offered_.push_back(std::move(scan));
}

void TeamService::Start() {
  for (const TeamScan& scan : offered_) sinks_.Tell(&TeamSink::TakeRelevantScan, scan);
  offered_ = {};
  host_.Start({.tell_status = [this] { sinks_.Tell(&TeamSink::TakeStatus, Status()); },
               .tell_maps = [this](const std::stop_token& stop) { PaintMaps(stop); },
               .map_period = kPaintPeriod});
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
  const bool is_new = Insert(scan, ToPoints(scan.scan), [](const MapAddition&) {});
  if (is_new) {
    maps_.Of(scan.key.robot)
        ->robots()
        .Report(scan.key.robot, scan.map_robot.T_a_b.translation_m(), steady_clock::now());
  }
  ++(is_new ? taken_in_ : duplicates_);
  if (!is_new) return;
  const std::lock_guard lock(extension_);
  of_others_.push_back(std::move(scan));
}

void TeamService::OfferTakenIn() {
  std::vector<TeamScan> scans;
  {
    const std::lock_guard lock(extension_);
    scans.swap(of_others_);
  }
  for (const TeamScan& scan : scans) sinks_.Tell(&TeamSink::TakeRelevantScan, scan);
}

// Nobody hears of a relevant scan before it is safe: who has heard of it may rely on it.
void TeamService::Extend(const TeamScan& scan, std::span<const ScanPoint> points) {
  Insert(scan, points, [this, shared = std::make_shared<TeamScan>(scan)](const MapAddition& added) {
    sinks_.Tell(&TeamSink::TakeRelevantScan, *shared);
    TellNewPoints(*shared, added);
  });
}

bool TeamService::Insert(const TeamScan& scan,
                         std::span<const ScanPoint> points,
                         const std::function<void(const MapAddition&)>& settled) {
  std::shared_ptr<const MapAddition> addition;
  {
    const std::lock_guard lock(extension_);
    addition = maps_.Of(scan.key.robot)->Insert(scan, points);
    if (!addition) return false;
    if (host_.journal()) {
      host_.journal().Append(ToJournal(scan), [settled, addition] { settled(*addition); });
      return true;
    }
  }
  settled(*addition);
  return true;
}

void TeamService::TellNewPoints(const TeamScan& scan, const MapAddition& addition) {
  std::vector<Eigen::Vector2d> points_map_m;
  points_map_m.reserve(addition.points.size());
  for (const MapPoint& point : addition.points) points_map_m.push_back(point.p_map_m);
  sinks_.Tell(&TeamSink::TakeNewPoints,
              {.robot = scan.key.robot, .stamp = scan.scan.stamp, .points_map_m = points_map_m});
}

MapStatus TeamService::StatusOfMaps() const {
  MapStatus status{
      .taken_in = taken_in_.load(), .duplicates = duplicates_.load(), .refused = refused_.load()};
  for (const TeamMaps::NamedMap& named : maps_.All()) {
    const TeamMap::State::View map = named.map->Read();
    status.scans += map->scans().size();
    status.points += map->surfaces().quadtree().size();
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
  for (const TeamMaps::NamedMap& named : maps_.All()) {
    MapPainter& painter = PainterOf(*named.map);
    painter.Paint(*named.map, stop);
    if (stop.stop_requested()) return;
    if (is_time_to_repeat || (is_time_to_tell && painter.has_news())) TellMap(named.robot, painter);
  }
}

void TeamService::TellMap(const std::string& robot, MapPainter& painter) {
  const std::optional<OccupancyGrid> grid = painter.Grid();
  if (grid) {
    sinks_.Tell(&TeamSink::TakeMap, {.robot = robot, .stamp = painter.newest(), .grid = *grid});
  }
  if (painter.trouble().empty()) return;
  const auto whose = robot.empty() ? std::nullopt : std::optional<std::string_view>(robot);
  sinks_.Tell(&TeamSink::TakeEvent,
              {.robot = whose, .is_warning = true, .text = painter.trouble()});
}

std::optional<OccupancyGrid> TeamService::DrawMapOf(std::string_view robot) {
  const std::shared_ptr<const TeamMap> map = maps_.Of(robot);
  MapPainter& painter = PainterOf(*map);
  painter.Paint(*map, {});
  return painter.Grid();
}

MapPainter& TeamService::PainterOf(const TeamMap& map) {
  return painters_.try_emplace(&map, options_.rendering).first->second;
}

std::shared_ptr<RobotSession> TeamService::MakeSession(std::string robot) {
  const auto extend = [this](const TeamScan& scan, std::span<const ScanPoint> points) {
    Extend(scan, points);
  };
  const auto report = [this](const RobotAnswer& answer) {
    host_.journal().TellWhenSafe([this, answer] { sinks_.Tell(&TeamSink::TakeReport, answer); });
  };
  const RobotStartOptions* const start = FindStart(options_.team, robot);
  SessionContext context{.service = identity(),
                         .map = *maps_.Of(robot),
                         .sinks = sinks_,
                         .start = start ? std::optional(PlanarStart(*start)) : std::nullopt,
                         .teammate_radius_m = options_.team.teammate_radius_m,
                         .extend = extend,
                         .report = report};
  return std::make_shared<RobotSession>(
      std::move(robot), options_.team.session, options_.mapper, std::move(context));
}

}  // namespace qwsm::team
