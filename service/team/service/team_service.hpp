// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/team/journal/service_journal.hpp"
#include "service/team/map/map_painter.hpp"
#include "service/team/map/team_maps.hpp"
#include "service/team/service/periodic_task.hpp"
#include "service/team/service/robot_session.hpp"
#include "service/team/service/team_options.hpp"
#include "service/team/session/session_list.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::team {

struct TeamServiceOptions {
  TeamOptions team;
  MapperOptions mapper;  ///< Its matcher is q-wsm, whatever it says.
  OccupancyGridOptions rendering;
};

/// Maps with a team of robots: takes their scans and odometry, answers each scan with a pose, keeps
/// their one map (or one map each) and shares it with other services.
///
/// All functions may be called from any thread, but not from the sink. A robot is known by its
/// namespace, such as `robot1`, or "" for the only one.
class TeamService {
 public:
  /// @param sink outlives this.
  /// @param journal where relevant scans are kept; the map begins with those in it. Empty: nowhere.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  TeamService(const TeamServiceOptions& options,
              TeamSink& sink,
              const std::filesystem::path& journal = {});
  /// Stops.
  ~TeamService();
  TeamService(const TeamService&) = delete;
  TeamService& operator=(const TeamService&) = delete;

  /// Hands what is in the journal to the sink, for the other services, and starts to work. What
  /// arrives before waits.
  void Start();
  /// Finishes the matches at work, saves what is to be saved, and works no more. What waits in
  /// queues is left out.
  void Stop();
  /// Waits until every scan that was taken is answered or dropped, and all is on disk that can be.
  void WaitUntilIdle();

  /// The name of the service in the keys of its relevant scans.
  const std::string& identity() const { return journal_.identity(); }

  /// A robot's publisher is there. What takes messages of a robot makes it join as well.
  void Join(std::string_view robot) { sessions_.Join(robot); }
  /// It is gone.
  void Lose(std::string_view robot) { sessions_.Lose(robot); }
  /// Another service answers it from now on.
  void HandOver(std::string_view robot) { sessions_.HandOver(robot); }
  /// @return false if the scan was refused: malformed, of a wrong time or a duplicate. See its
  /// counts.
  bool TakeScan(std::string_view robot, LaserScan scan) {
    return sessions_.TakeScan(robot, std::move(scan));
  }
  void TakeOdometry(std::string_view robot, Timestamp stamp, const Pose2& T_odom_robot) {
    sessions_.TakeOdometry(robot, stamp, T_odom_robot);
  }
  /// Whether somebody publishes its odometry: only then do scans wait for it.
  void ExpectOdometry(std::string_view robot, bool expected) {
    sessions_.ExpectOdometry(robot, expected);
  }
  void PlaceAt(std::string_view robot, const UncertainPose2& map_robot) {
    sessions_.PlaceAt(robot, map_robot);
  }

  /// Takes in relevant scans of other services, several at once where they are there: they are
  /// inserted by stamp, so that services that start late get the same map from the same scans.
  /// What is known already, or came from this service, is passed over.
  void TakeIn(std::vector<TeamScan> scans);
  /// Another service is gone: this one offers what it took in, for those that come later. So what
  /// one service has is never lost to the team.
  void OfferTakenIn();

  TeamStatus Status() const;
  /// The map a robot is matched against; the team's where all share one.
  std::shared_ptr<const TeamMap> MapOf(std::string_view robot) { return maps_.Of(robot); }
  /// That map, drawn at the cost of what was not drawn while the service ran; nothing where it is
  /// empty or too large. @pre the service has stopped.
  std::optional<OccupancyGrid> DrawMapOf(std::string_view robot);

 private:
  std::shared_ptr<RobotSession> MakeSession(std::string robot);
  void Extend(const TeamScan& scan, std::span<const ScanPoint> points);
  void TakeInOne(TeamScan scan);
  void Restore(TeamScan scan);
  bool Insert(const TeamScan& scan,
              std::span<const ScanPoint> points,
              const std::function<void(const MapAddition&)>& settled);
  void TellNewPoints(const TeamScan& scan, const MapAddition& addition);
  void PaintMaps(const std::stop_token& stop);
  void TellMap(const std::string& robot, MapPainter& painter);
  MapPainter& PainterOf(const TeamMap& map);
  MapStatus StatusOfMaps() const;

  const TeamServiceOptions options_;
  TeamSink& sink_;
  const std::chrono::steady_clock::time_point begun_;
  TeamMaps maps_;
  std::mutex extension_;             // Keeps the journal in the order of the map.
  std::vector<TeamScan> offered_;    // From the journal, until the start.
  std::vector<TeamScan> of_others_;  // Taken in, and offered by those whose they are.
  std::atomic<std::uint64_t> taken_in_ = 0;
  std::atomic<std::uint64_t> duplicates_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;

  SessionList<RobotSession> sessions_;
  // Of the task that paints, while it runs.
  std::map<const TeamMap*, MapPainter> painters_;
  std::chrono::steady_clock::time_point maps_told_{};
  std::chrono::steady_clock::time_point maps_repeated_{};

  ServiceJournal journal_;
  std::unique_ptr<PeriodicTask> painting_;
  std::unique_ptr<PeriodicTask> reporting_;
};

}  // namespace qwsm::team
