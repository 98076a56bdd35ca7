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
#include <unordered_map>
#include <utility>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/team/map/map_painter.hpp"
#include "service/team/map/team_corrector.hpp"
#include "service/team/map/team_maps.hpp"
#include "service/team/service/robot_session.hpp"
#include "service/team/service/session_host.hpp"
#include "service/team/service/team_options.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::team {

struct TeamServiceOptions {
  TeamOptions team;
  MapperOptions mapper;  ///< The matcher is q-wsm, whatever the options say.
  bool corrects = true;  ///< Whether maps are corrected while robots drive.
  OccupancyGridOptions rendering;
};

/// Maps with a team of robots: takes their scans and odometry, answers each scan with a pose, keeps
/// their one map (or one map each) and shares it with other services.
///
/// All functions may be called from any thread, but not from the sinks.
class TeamService {
 public:
  /// Opens the journal; the map begins with the scans in it.
  /// @param journal where relevant scans are kept; empty: nowhere.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  TeamService(const TeamServiceOptions& options,
              SinkList<TeamSink> sinks,
              const std::filesystem::path& journal = {});
  /// Stops as Stop() does.
  ~TeamService();
  TeamService(const TeamService&) = delete;
  TeamService& operator=(const TeamService&) = delete;

  /// Hands what is in the journal to the sink, for the other services, and starts to work. What
  /// arrives before waits.
  void Start();
  /// Finishes the matches at work, saves what is to be saved, and works no more. What waits in
  /// queues is left out.
  void Stop() { host_.Stop(); }
  /// Waits until every scan that was taken is answered or dropped, and all that can be is on disk.
  void WaitUntilIdle() { host_.WaitUntilIdle(); }

  /// The name of the service in the keys of its relevant scans.
  const std::string& identity() const { return host_.identity(); }
  /// The robots of the service, by name: they take what robots say.
  SessionList<RobotSession>& robots() { return host_.sessions(); }
  /// The topics of a robot's scans, below its namespace.
  std::vector<std::string> scan_topics() const { return ScanTopicsOf(options_.team); }

  /// Takes in relevant scans of other services, several at once where they are there: they are
  /// inserted by stamp, so that services that start late get the same map from the same scans.
  /// What is known already, or came from this service, is passed over.
  void TakeIn(std::vector<TeamScan> scans);
  /// Takes in a correction of the team's map that another service found. It counts if it is newer
  /// than what this service knows: of a greater number, or of the same and a greater service.
  void TakeIn(const TeamEpoch& epoch);
  /// Offers what this service took in of another one that is gone, for those that come later. So
  /// what one service has is never lost to the team.
  void OfferTakenIn();

  TeamStatus Status() const { return host_.Status(StatusOfMaps()); }
  /// The map a robot is matched against; the team's where all share one.
  std::shared_ptr<const TeamMap> MapOf(std::string_view robot) { return maps_.Of(robot); }
  /// The map a robot is matched against, drawn at the cost of what was not drawn while the service
  /// ran; nothing where it is empty or too large.
  /// @pre the service has stopped.
  std::optional<OccupancyGrid> DrawMapOf(std::string_view robot);

 private:
  std::shared_ptr<RobotSession> MakeSession(std::string robot);
  std::optional<ScanId> Extend(const TeamScan& scan, std::span<const ScanPoint> points);
  void TakeInOne(TeamScan scan);
  void Restore(TeamScan scan);
  std::optional<ScanId> Insert(const TeamScan& scan,
                               std::span<const ScanPoint> points,
                               const std::function<void(const MapAddition&)>& settled);
  void Keep(io::JournalEntry entry, std::function<void()> settled);
  void TellAsEvent(const TeamEpoch& epoch) const;
  TeamCorrector& CorrectorOf(const TeamMap& map);
  void CorrectIfDue(const std::string& robot, TeamMap& map);
  EpochRank Next(const EpochRank& last) const;
  void TakeEffect(const std::string& robot, TeamMap& map, CorrectedMap corrected);
  TeamEpoch EpochOf(const std::string& robot, const TeamMap& map, const CorrectedMap& corrected);
  void TellNewPoints(const TeamScan& scan, const MapAddition& addition);
  void PaintMaps(const std::stop_token& stop);
  void TellMap(const std::string& robot, MapPainter& painter);
  MapPainter& PainterOf(const TeamMap& map);
  MapStatus StatusOfMaps() const;

  const TeamServiceOptions options_;
  const SinkList<TeamSink> sinks_;
  TeamMaps maps_;
  std::mutex extension_;  // Keeps the journal in the order of the map; guards what follows.
  std::map<const TeamMap*, TeamCorrector> correctors_;
  EpochRank epoch_;  // Of the last correction of any map.
  // Poses of scans that the last correction by another service names.
  std::unordered_map<ScanKey, UncertainPose2, ScanKeyHash> named_by_others_;
  std::vector<TeamScan> offered_;    // Scans from the journal, until the start.
  std::vector<TeamScan> of_others_;  // Scans taken in from other services, which offer them.
  std::atomic<std::uint64_t> taken_in_ = 0;
  std::atomic<std::uint64_t> duplicates_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;

  // The task that paints alone uses these, while it runs.
  std::map<const TeamMap*, MapPainter> painters_;
  std::chrono::steady_clock::time_point maps_told_{};
  std::chrono::steady_clock::time_point maps_repeated_{};

  SessionHost<RobotSession> host_;  // Last: its threads use all members above.
};

}  // namespace qwsm::team
