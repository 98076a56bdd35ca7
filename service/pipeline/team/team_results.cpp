// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_results.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

namespace fs = std::filesystem;

// Of a path that is drawn: a service may run for months.
constexpr std::size_t kMostPoses = 20'000;

/// What one robot leaves.
class TeamResults::RobotResults {
 public:
  explicit RobotResults(fs::path folder) : folder_(std::move(folder)) {}

  void Take(const TimedStep& timed) {
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
  }

  void Finish(const ScanMap& map, const OccupancyGrid* grid) {
    if (has_failed_ || !files_) return;
    files_->first.Commit();
    files_->second.Commit();
    io::WriteTextFile(folder_ / "metrics.json",
                      MetricsJson(statistics_, map, MatcherKind::kQWsm, std::nullopt).Text());
    if (grid) io::WriteTrajectoryPicture(folder_ / "trajectory.png", *grid, history_.Overlay());
  }

  const fs::path& folder() const { return folder_; }

 private:
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
             .T_odom_robot = answer.T_odom_robot});
}

TeamResults::RobotResults& TeamResults::ResultsOf(const std::string& robot) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<RobotResults>& results = robots_[robot];
  if (!results) results = std::make_unique<RobotResults>(folder_.path() / robot);
  return *results;
}

void TeamResults::Finish(team::TeamService& service) {
  std::map<const team::TeamMap*, std::optional<OccupancyGrid>> drawn;
  std::vector<std::function<void()>> tasks;
  const auto draw = [&](const std::string& robot, const fs::path& folder) {
    const std::shared_ptr<const team::TeamMap> map = service.MapOf(robot);
    const auto [known, is_new] = drawn.try_emplace(map.get());
    if (is_new && !map->Read()->map.empty()) known->second = Draw(service, robot);
    const OccupancyGrid* const grid = known->second ? &*known->second : nullptr;
    if (is_new && grid) {
      tasks.push_back([grid, folder] { io::WriteRosMap(folder / "map.yaml", *grid); });
      tasks.push_back([grid, folder] { io::WriteMapPicture(folder / "map.png", *grid); });
    }
    return grid;
  };
  draw("", folder_.path());  // The team's, where it shares one.
  for (const auto& [robot, results] : robots_) {
    const OccupancyGrid* const grid = draw(robot, results->folder());
    tasks.push_back([&service, &robot, &results, grid] {
      results->Finish(service.MapOf(robot)->Read()->map, grid);
    });
  }
  RunInParallel(tasks);
}

std::optional<OccupancyGrid> TeamResults::Draw(team::TeamService& service,
                                               const std::string& robot) const {
  std::optional<OccupancyGrid> grid = service.DrawMapOf(robot);
  return grid ? std::move(grid) : RenderOrWarn(service.MapOf(robot)->Read()->map, rendering_);
}

}  // namespace qwsm::pipeline
