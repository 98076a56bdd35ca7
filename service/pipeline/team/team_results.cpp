// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_results.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/metrics/pose_lookup.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/io/pictures/team_picture.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/corrected_run.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/team/robot_path.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

namespace fs = std::filesystem;

// Of a path that is drawn: a service may run for months.
constexpr std::size_t kMostPoses = 20'000;

/// What one robot leaves.
class TeamResults::RobotResults {
 public:
  RobotResults(const ResultsFolder& of_team, std::string robot, bool corrects)
      : of_team_(of_team), robot_(std::move(robot)), corrects_(corrects) {}

  void Take(const TimedStep& timed, const team::RobotAnswer& answer) {
    if (has_failed_) return;
    try {
      if (!files_) Open();
      files_->first.Take(timed);
      files_->second.Take(timed);
    } catch (const io::WriteError& error) {
      messages::Error("{}; the results end here{}", error.what(), EndUnfinished());
    }
    statistics_.Take(timed);
    history_.Take(timed);
    path_.Take(answer);
  }

  /// Leaves what was answered. @throws io::WriteError; then it is left unfinished.
  void FinishAnswers() {
    if (has_failed_ || !files_) return;
    try {
      files_->first.Commit();
      files_->second.Commit();
    } catch (const io::WriteError& error) {
      throw io::WriteError(error.what() + EndUnfinished());
    }
  }

  /// Places the answers in the map as it is in the end. @return the path there.
  const std::vector<io::PathPose>& PlaceIn(const RobotInMap& map) {
    map_robot_ = path_.In(map);
    return placed_ = path_.PathOf(map_robot_);
  }

  /// Leaves what is known of them in the end. @pre they are placed in the map.
  void Finish(const FinalMap& map);

  fs::path folder() const { return of_team_ / robot_; }

 private:
  // Says where what was written until now is, if anything was.
  std::string EndUnfinished() {
    has_failed_ = true;
    if (!files_) return {};
    const std::string trajectory = files_->first.KeepUnfinished();
    const std::string table = files_->second.KeepUnfinished();
    files_.reset();
    return "; what was written before is in " + trajectory + " and " + table;
  }

  // With the path as it was answered in that map. Odometry begins where the path does.
  io::MapOverlay OverlayOf(std::vector<io::PathPose> path, std::uint64_t map) const {
    io::MapOverlay overlay = history_.Overlay();
    if (path.empty()) return overlay;
    Trajectory answered = io::TrajectoryOf(overlay.path);
    const auto then = NearestIndex(answered, path.front().stamp, Timestamp::max());
    const Pose2 T_now_then = path.front().map_robot.T_a_b * answered[*then].T_map_robot.Inverse();
    for (StampedPose2& pose : overlay.odometry) pose.T_map_robot = T_now_then * pose.T_map_robot;
    std::erase_if(answered,
                  [&](const StampedPose2& pose) { return path_.MapAt(pose.stamp) != map; });
    overlay.path = std::move(path);
    if (io::TrajectoryOf(overlay.path) != answered) overlay.answered = std::move(answered);
    return overlay;
  }

  void Open() {
    const ResultsFolder folder = of_team_.Part(robot_, true);  // Of an earlier run nothing is left.
    files_ = std::make_unique<std::pair<TrajectorySink, ScanTableSink>>(
        std::piecewise_construct,
        std::forward_as_tuple(folder /
                              (corrects_ ? ResultFile::kLiveTrajectory : ResultFile::kTrajectory)),
        std::forward_as_tuple(folder / ResultFile::kScans));
  }

  const ResultsFolder& of_team_;
  std::string robot_;
  bool corrects_;
  bool has_failed_ = false;
  std::unique_ptr<std::pair<TrajectorySink, ScanTableSink>> files_;
  RunStatistics statistics_;
  RunHistory history_{kMostPoses};
  RobotPath path_;
  std::vector<std::optional<UncertainPose2>> map_robot_;  // In the end, of each answer.
  std::vector<io::PathPose> placed_;                      // Those that have a place there.
};

/// A map as it is in the end, with those in it.
struct TeamResults::FinalMap {
  fs::path folder;
  std::shared_ptr<const team::TeamMap> known;  ///< As the robots know it.
  std::optional<Correction> correction{};
  std::vector<RelevantScan> scans{};      ///< Where they are in the end.
  std::optional<OccupancyGrid> grid{};    ///< As it is in the end.
  std::optional<OccupancyGrid> before{};  ///< As the robots know it, where it is corrected.
  std::map<std::string, RobotInMap> robots_in{};
  std::vector<io::RobotPath> paths{};
};

void TeamResults::RobotResults::Finish(const FinalMap& map) {
  if (has_failed_ || !files_) return;
  if (corrects_) {
    AddCorrectedPoses(folder() / ResultFile::kScans, map_robot_);
    const Trajectory trajectory = io::TrajectoryOf(placed_);
    io::WriteTumFile(folder() / ResultFile::kTrajectory, trajectory);
    io::WriteKittiFile(folder() / ResultFile::kTrajectoryKitti, trajectory);
  }
  const team::TeamMap::State::View known = map.known->Read();
  std::optional<LoopCounts> loops;
  if (map.correction) loops = CountLoops(*map.correction, known->epoch);
  io::WriteTextFile(
      folder() / ResultFile::kMetrics,
      MetricsJson(statistics_, FiguresOf(known->map), MatcherKind::kQWsm, std::nullopt, loops)
          .Text());
  if (!map.grid) return;
  io::MapOverlay overlay = OverlayOf(std::move(placed_), map.known->VersionOf(*known).map);
  if (map.correction) overlay.loops = LoopLines(*map.correction);
  io::WriteTrajectoryPicture(folder() / ResultFile::kTrajectoryPicture, *map.grid, overlay);
}

TeamResults::TeamResults(const ResultsFolder& folder, const TeamResultsOptions& options)
    : folder_(folder), options_(options) {}

TeamResults::~TeamResults() = default;

void TeamResults::TakeAnswer(const team::RobotAnswer& answer) {
  // What a worker of the service worked of that time is not measured.
  ResultsOf(answer.robot)
      .Take({.step = answer.step,
             .duration = answer.matching,
             .worked = answer.matching,
             .T_odom_robot = answer.T_odom_robot},
            answer);
}

TeamResults::RobotResults& TeamResults::ResultsOf(const std::string& robot) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<RobotResults>& results = robots_[robot];
  if (!results) {
    results = std::make_unique<RobotResults>(folder_, robot, options_.corrects);
  }
  return *results;
}

void TeamResults::Finish(team::TeamService& service) {
  std::vector<std::function<void()>> tasks;
  for (const auto& [_, results] : robots_) {
    try {
      results->FinishAnswers();
    } catch (const io::WriteError& error) {
      tasks.emplace_back([error] { throw error; });  // Once what the others leave is written.
    }
  }
  std::map<const team::TeamMap*, FinalMap> maps;
  const auto map_of = [&](const std::string& robot, const fs::path& folder) -> FinalMap& {
    const auto [known, is_new] = maps.try_emplace(service.MapOf(robot).get());
    if (is_new) known->second = FinishMap(service, robot, folder);
    return known->second;
  };
  map_of("", folder_.path());  // The team's, where it shares one.
  for (const auto& [robot, results] : robots_) {
    FinalMap& map = map_of(robot, results->folder());
    const std::vector<io::PathPose>& path = results->PlaceIn(map.robots_in[robot]);
    map.paths.push_back({.robot = robot, .path = io::TrajectoryOf(path)});
    tasks.push_back([&results, &map] { results->Finish(map); });
  }
  for (const auto& [_, map] : maps) {
    for (const auto& [robot, in_map] : map.robots_in) {
      for (const auto& [stamp, map_robot] : in_map.map_robot) {
        scans_.push_back({.robot = robot, .stamp = stamp, .T_map_robot = map_robot.T_a_b});
      }
    }
    if (map.correction) {
      tasks.push_back([&map] { WriteLoops(map.folder, *map.correction, map.scans); });
    }
    if (map.before) {
      tasks.push_back(
          [&map] { io::WriteMapPicture(map.folder / ResultFile::kLiveMapPicture, *map.before); });
    }
    if (!map.grid) continue;
    tasks.push_back([&map] { io::WriteRosMap(map.folder / ResultFile::kMap, *map.grid); });
    tasks.push_back([&map] {
      io::WriteTeamPicture(map.folder / ResultFile::kMapPicture, *map.grid, map.paths);
    });
  }
  RunInParallel(tasks);
}

std::vector<team::Mark> TeamResults::Placed(std::span<const team::Mark> marks) const {
  return team::PlacedOn(scans_, marks);
}

TeamResults::FinalMap TeamResults::FinishMap(team::TeamService& service,
                                             std::string_view robot,
                                             const fs::path& folder) const {
  FinalMap end{.folder = folder, .known = service.MapOf(robot)};
  {  // Let go before the atlas is asked: who extends a map locks the atlas first.
    const team::TeamMap::State::View known = end.known->Read();
    end.scans.assign(known->map.scans().begin(), known->map.scans().end());
  }
  const std::uint64_t number = end.known->version().map;
  for (const auto& [name, _] : robots_) end.robots_in[name].map = number;
  if (end.scans.empty()) return end;
  end.grid = service.DrawMapOf(robot);
  if (!end.grid) end.grid = RenderOrWarn(end.scans, options_.rendering);
  end.correction = service.FinishMapOf(robot);
  if (end.correction) {
    for (RelevantScan& scan : end.scans) scan.map_robot = end.correction->map_node[scan.id];
    end.before = std::move(end.grid);
    end.grid = RenderOrWarn(end.scans, options_.rendering);
  }
  for (const RelevantScan& scan : end.scans) {
    RobotInMap& in_map = end.robots_in[end.known->KeyOf(scan.id).robot];
    in_map.map_robot.emplace(scan.scan.stamp, scan.map_robot);
  }
  return end;
}

}  // namespace qwsm::pipeline
