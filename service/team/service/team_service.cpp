// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/team_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "qwsm/geometry/frame_covariance.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/team/journal/journaled_map.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

// Maps are painted this often, however seldom they are told: little is left to do at the end.
constexpr std::chrono::duration<double> kPaintPeriod{0.2};

// A map that does not change is told again for readers that do not ask for what was before them.
constexpr std::chrono::seconds kMapRepetition{10};

// As whose the map is known that all share.
const std::string kTeam;

TeamServiceOptions WithQuadtree(TeamServiceOptions options) {
  options.mapper.matcher = MatcherKind::kQWsm;
  return options;
}

// Poses of all scans of a map, some of which were told.
struct Followed {
  std::vector<UncertainPose2> map_node;
  bool moves_others = false;  // Whether scans of which nothing was told are moved with them.
};

// Who is not told of keeps its place beside the last scan of its robot that is.
Followed Follow(const TeamMap& map,
                const std::unordered_map<ScanKey, UncertainPose2, ScanKeyHash>& told) {
  Followed followed;
  std::map<std::string, ScanId> last_told;
  const TeamMap::State::View contents = map.Read();
  for (const RelevantScan& scan : contents->map.scans()) {
    const ScanKey key = map.KeyOf(scan.id);
    UncertainPose2& pose = followed.map_node.emplace_back(scan.map_robot);
    if (const auto of_it = told.find(key); of_it != told.end()) {
      pose = of_it->second;
      last_told[key.robot] = scan.id;
    } else if (const auto last = last_told.find(key.robot); last != last_told.end()) {
      const UncertainPose2& before = contents->map.scans()[last->second].map_robot;
      const UncertainPose2& after = followed.map_node[last->second];
      if (before.T_a_b == after.T_a_b) continue;
      pose = after * Since(before, scan.map_robot);
      followed.moves_others = true;
    }
  }
  return followed;
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
  JournaledMap map;
  host_.Restore([&](const io::JournalEntry& entry) { map.Take(entry); });
  epoch_.number = map.last_epoch();
  for (TeamScan& scan : map.TakeScans()) Restore(std::move(scan));
}

TeamService::~TeamService() { Stop(); }

void TeamService::Restore(TeamScan scan) {
  const std::shared_ptr<TeamMap> map = maps_.Of(scan.key.robot);
  if (!map->Insert(scan, ToPoints(scan.scan))) return;
  if (options_.corrects) CorrectorOf(*map).Take(scan);
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
  {
    const std::lock_guard lock(extension_);
    const auto told = named_by_others_.find(scan.key);
    if (told != named_by_others_.end()) scan.map_robot = told->second;
  }
  const bool is_new = Insert(scan, ToPoints(scan.scan), [](const MapAddition&) {}).has_value();
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

void TeamService::TakeIn(const TeamEpoch& epoch) {
  const std::lock_guard lock(extension_);
  const bool is_wanted = options_.corrects && options_.team.map == MapSharing::kTeam;
  if (!is_wanted || epoch.rank <= epoch_) return;
  named_by_others_.clear();
  for (const MovedScan& scan : epoch.scans) named_by_others_[scan.key] = scan.map_robot;
  TeamMap& map = *maps_.Of(kTeam);
  Followed followed = Follow(map, named_by_others_);
  // Whoever knows of scans that the other one did not tells where these are now.
  epoch_ = followed.moves_others ? Next(epoch.rank) : epoch.rank;
  TakeEffect(kTeam, map, CorrectorOf(map).Adopt(std::move(followed.map_node)));
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
std::optional<ScanId> TeamService::Extend(const TeamScan& scan, std::span<const ScanPoint> points) {
  return Insert(
      scan, points, [this, shared = std::make_shared<TeamScan>(scan)](const MapAddition& added) {
        sinks_.Tell(&TeamSink::TakeRelevantScan, *shared);
        TellNewPoints(*shared, added);
      });
}

std::optional<ScanId> TeamService::Insert(const TeamScan& scan,
                                          std::span<const ScanPoint> points,
                                          const std::function<void(const MapAddition&)>& settled) {
  const std::lock_guard lock(extension_);
  const std::shared_ptr<TeamMap> map = maps_.Of(scan.key.robot);
  const std::optional<TeamMap::Insertion> insertion = map->Insert(scan, points);
  if (!insertion) return std::nullopt;
  Keep(ToJournal(scan), [settled, addition = insertion->addition] { settled(*addition); });
  if (options_.corrects) {
    CorrectorOf(*map).Take(scan);
    CorrectIfDue(scan.key.robot, *map);
  }
  return insertion->id;
}

void TeamService::Keep(io::JournalEntry entry, std::function<void()> settled) {
  if (!host_.journal()) return settled();
  host_.journal().Append(std::move(entry), std::move(settled));
}

void TeamService::CorrectIfDue(const std::string& robot, TeamMap& map) {
  std::optional<CorrectedMap> corrected = CorrectorOf(map).LookIfDue();
  if (!corrected) return;
  epoch_ = Next(epoch_);
  TakeEffect(robot, map, std::move(*corrected));
}

EpochRank TeamService::Next(const EpochRank& last) const {
  return {.number = last.number + 1, .service = identity()};
}

void TeamService::TakeEffect(const std::string& robot, TeamMap& map, CorrectedMap corrected) {
  const auto epoch = std::make_shared<const TeamEpoch>(EpochOf(robot, map, corrected));
  map.Correct(std::move(corrected.map));
  TellAsEvent(*epoch);
  std::map<ScanKey, const UncertainPose2*> poses;
  for (const MovedScan& scan : epoch->scans) poses[scan.key] = &scan.map_robot;
  for (TeamScan& scan : of_others_) {
    if (const auto moved = poses.find(scan.key); moved != poses.end()) {
      scan.map_robot = *moved->second;
    }
  }
  Keep(ToJournal(*epoch), [this, epoch] { sinks_.Tell(&TeamSink::TakeEpoch, *epoch); });
}

TeamEpoch TeamService::EpochOf(const std::string& robot,
                               const TeamMap& map,
                               const CorrectedMap& corrected) {
  TeamEpoch epoch{.rank = epoch_,
                  .robot = options_.team.map == MapSharing::kTeam ? std::string() : robot,
                  .stamp = {},
                  .scans = {}};
  const TeamMap::State::View before = map.Read();
  for (const RelevantScan& scan : before->map.scans()) {
    epoch.stamp = std::max(epoch.stamp, scan.scan.stamp);
    epoch.scans.push_back({.key = map.KeyOf(scan.id),
                           .T_map_robot_before = scan.map_robot.T_a_b,
                           .map_robot = corrected.map_node[scan.id]});
  }
  return epoch;
}

void TeamService::TellAsEvent(const TeamEpoch& epoch) const {
  double farthest_m = 0.0;
  for (const MovedScan& scan : epoch.scans) {
    const Eigen::Vector2d moved_m =
        scan.map_robot.T_a_b.translation_m() - scan.T_map_robot_before.translation_m();
    farthest_m = std::max(farthest_m, moved_m.norm());
  }
  const std::string text =
      fmt::format("the map was corrected{}: its scans move by up to {:.2f} m",
                  epoch.rank.service == identity() ? "" : " by " + epoch.rank.service,
                  farthest_m);
  sinks_.Tell(&TeamSink::TakeEvent, {.robot = std::nullopt, .is_warning = false, .text = text});
}

TeamCorrector& TeamService::CorrectorOf(const TeamMap& map) {
  return correctors_.try_emplace(&map, options_.mapper).first->second;
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
    const TeamMap::State::View contents = named.map->Read();
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
    return Extend(scan, points);
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
                         .correction = CorrectionOf(options_.team.correction, robot),
                         .extend = extend,
                         .report = report};
  return std::make_shared<RobotSession>(
      std::move(robot), options_.team.session, options_.mapper, std::move(context));
}

}  // namespace qwsm::team
