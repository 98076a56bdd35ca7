// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_results.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/team_picture.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/team/path_in_map.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

namespace fs = std::filesystem;

// Of a path that is drawn: a service may run for months.
constexpr std::size_t kMostPoses = 20'000;

/// What one robot leaves.
class TeamResults::RobotResults {
 public:
  explicit RobotResults(fs::path folder) : folder_(std::move(folder)) {}

  void Take(const TimedStep& timed, const team::MapVersion& version) {
    if (has_failed_) return;
    try {
      if (!files_) Open();
      files_->first.Take(timed);
      files_->second.Take(timed);
    } catch (const io::WriteError& error) {
      has_failed_ = true;
      messages::Error("{}; the results end here", error.what());
    }
    statistics_.Take(timed);
    history_.Take(timed);
    const MappingStep& step = timed.step;
    if (stretches_.empty() || stretches_.back().version != version) {
      stretches_.push_back({.version = version, .since = step.stamp, .relevant = {}});
    }
    if (!step.relevant) return;
    stretches_.back().relevant.push_back(
        {.stamp = step.relevant_scan.stamp, .T_map_robot = step.map_relevant.T_a_b});
  }

  std::vector<io::PathPose> PathIn(const ScansInMap& map) const {
    return PathInMap(history_.path(), stretches_, map);
  }

  void Finish(const ScanMap& map, const OccupancyGrid* grid, std::vector<io::PathPose> path) {
    if (has_failed_ || !files_) return;
    files_->first.Commit();
    files_->second.Commit();
    io::WriteTextFile(folder_ / "metrics.json",
                      MetricsJson(statistics_, map, MatcherKind::kQWsm, std::nullopt).Text());
    if (!grid) return;
    io::WriteTrajectoryPicture(folder_ / "trajectory.png", *grid, OverlayOf(std::move(path)));
  }

  const fs::path& folder() const { return folder_; }

 private:
  // With the path as it was answered where that is another one. Odometry begins where that does.
  io::MapOverlay OverlayOf(std::vector<io::PathPose> path) const {
    io::MapOverlay overlay = history_.Overlay();
    const Trajectory answered = io::TrajectoryOf(overlay.path);
    if (path.empty() || io::TrajectoryOf(path) == answered) return overlay;
    const auto then = std::ranges::find(answered, path.front().stamp, &StampedPose2::stamp);
    const Pose2 T_now_then = path.front().map_robot.T_a_b * then->T_map_robot.Inverse();
    for (StampedPose2& pose : overlay.odometry) pose.T_map_robot = T_now_then * pose.T_map_robot;
    overlay.answered = answered;
    overlay.path = std::move(path);
    return overlay;
  }

  void Open() {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw io::WriteError(folder_.string() + ": cannot be created: " + error.message());
    files_ = std::make_unique<std::pair<TrajectorySink, ScanTableSink>>(
        std::piecewise_construct,
        std::forward_as_tuple(folder_ / "trajectory.tum"),
        std::forward_as_tuple(folder_ / "scans.csv"));
  }

  fs::path folder_;
  bool has_failed_ = false;
  std::unique_ptr<std::pair<TrajectorySink, ScanTableSink>> files_;
  RunStatistics statistics_;
  RunHistory history_{kMostPoses};
  std::vector<AnsweredStretch> stretches_;
};

/// A map that is drawn, with those in it.
struct TeamResults::DrawnMap {
  fs::path folder;
  std::optional<OccupancyGrid> grid;
  std::map<std::string, ScansInMap> scans;  // By robot.
  std::vector<io::RobotPath> robots;
};

TeamResults::TeamResults(const ResultsFolder& folder, const OccupancyGridOptions& rendering)
    : folder_(folder), rendering_(rendering) {}

TeamResults::~TeamResults() = default;

void TeamResults::TakeAnswer(const team::RobotAnswer& answer) {
  // What a worker of the service worked of that time is not measured.
  ResultsOf(answer.robot)
      .Take({.step = answer.step,
             .duration = answer.matching,
             .worked = answer.matching,
             .T_odom_robot = answer.T_odom_robot},
            answer.version);
}

TeamResults::RobotResults& TeamResults::ResultsOf(const std::string& robot) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<RobotResults>& results = robots_[robot];
  if (!results) results = std::make_unique<RobotResults>(folder_.path() / robot);
  return *results;
}

void TeamResults::Finish(team::TeamService& service) {
  std::map<const team::TeamMap*, DrawnMap> maps;
  const auto map_of = [&](const std::string& robot, const fs::path& folder) -> DrawnMap& {
    const auto [known, is_new] = maps.try_emplace(service.MapOf(robot).get());
    if (is_new) known->second = Draw(service, robot, folder);
    return known->second;
  };
  std::vector<std::function<void()>> tasks;
  map_of("", folder_.path());  // The team's, where it shares one.
  for (const auto& [robot, results] : robots_) {
    DrawnMap& map = map_of(robot, results->folder());
    std::vector<io::PathPose> path = results->PathIn(map.scans[robot]);
    map.robots.push_back({.robot = robot, .path = io::TrajectoryOf(path)});
    tasks.push_back([&service, &robot, &results, &map, path = std::move(path)] {
      const OccupancyGrid* const grid = map.grid ? &*map.grid : nullptr;
      results->Finish(service.MapOf(robot)->Read()->map, grid, path);
    });
  }
  for (const auto& [_, map] : maps) {
    if (!map.grid) continue;
    tasks.push_back([&map] { io::WriteRosMap(map.folder / "map.yaml", *map.grid); });
    tasks.push_back(
        [&map] { io::WriteTeamPicture(map.folder / "map.png", *map.grid, map.robots); });
  }
  RunInParallel(tasks);
}

TeamResults::DrawnMap TeamResults::Draw(team::TeamService& service,
                                        const std::string& robot,
                                        const fs::path& folder) const {
  const std::shared_ptr<const team::TeamMap> map = service.MapOf(robot);
  DrawnMap drawn{.folder = folder, .grid = {}, .scans = {}, .robots = {}};
  const team::TeamMap::State::View contents = map->Read();
  for (const auto& [name, _] : robots_) drawn.scans[name].version = map->VersionOf(*contents);
  for (const RelevantScan& scan : contents->map.scans()) {
    drawn.scans[map->KeyOf(scan.id).robot].T_map_robot[scan.scan.stamp] = scan.map_robot.T_a_b;
  }
  if (contents->map.empty()) return drawn;
  drawn.grid = service.DrawMapOf(robot);
  if (!drawn.grid) drawn.grid = RenderOrWarn(contents->map, rendering_);
  return drawn;
}

}  // namespace qwsm::pipeline
