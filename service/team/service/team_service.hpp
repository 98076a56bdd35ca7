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
#include "service/team/atlas/map_merger.hpp"
#include "service/team/atlas/team_atlas.hpp"
#include "service/team/map/map_painter.hpp"
#include "service/team/service/epoch_intake.hpp"
#include "service/team/service/periodic_task.hpp"
#include "service/team/service/robot_session.hpp"
#include "service/team/service/session_host.hpp"
#include "service/team/service/team_options.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::team {

struct TeamServiceOptions {
  TeamOptions team;
  MapperOptions mapper;  ///< The matcher is q-wsm, whatever the options say.
  bool corrects = true;  ///< Whether maps are corrected while robots drive.
  /// Whether components of the map are looked for in one another beside the robots, or only where
  /// somebody waits for that; see WaitUntilIdle().
  bool merges_beside = true;
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

  /// Hands what is in the journal, scans and the last correction, to the sink, for the other
  /// services, and starts to work. What arrives before waits.
  void Start();
  /// Finishes the matches at work, saves what is to be saved, and works no more. What waits in
  /// queues is left out.
  void Stop();
  /// Waits until every scan that was taken is answered or dropped, corrections have taken effect,
  /// and all that can be is on disk. Where components are not looked for in one another beside,
  /// does that with what robots saw last.
  void WaitUntilIdle();

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
  /// Takes in a correction of the team's maps that another service found. It counts if it is newer
  /// than what this service knows: of a greater number, or of the same and a greater service. It
  /// takes effect later; WaitUntilIdle() waits for that.
  void TakeIn(TeamEpoch epoch) { epochs_.Put(std::move(epoch)); }
  /// Offers what this service took in of another one that is gone, for those that come later. So
  /// what one service has is never lost to the team.
  void OfferTakenIn();

  TeamStatus Status() const;
  /// The map a robot is matched against; the team's where all share one.
  std::shared_ptr<const TeamMap> MapOf(std::string_view robot) {
    return atlas_.maps().Of(robot).map;
  }
  /// Where the scans of the map that a robot is matched against belong, corrected once more;
  /// nothing where it is empty, or maps are not corrected, or where services made it together. To
  /// be asked for once.
  /// @pre the service has stopped.
  std::optional<Correction> FinishMapOf(std::string_view robot) {
    return atlas_.Finish(atlas_.maps().Of(robot).name);
  }
  /// The map a robot is matched against, drawn at the cost of what was not drawn while the service
  /// ran; nothing where it is empty or too large.
  /// @pre the service has stopped.
  std::optional<OccupancyGrid> DrawMapOf(std::string_view robot);

 private:
  std::shared_ptr<RobotSession> MakeSession(std::string robot);
  void TakeInOne(TeamScan scan);
  void Keep(io::JournalEntry entry, const std::function<void()>& settled);
  void Join(const ComponentPlace& place);
  void MergeMaps(const std::stop_token& stop);
  void PaintMaps(const std::stop_token& stop);
  void TellMap(const std::string& component, MapPainter& painter);
  MapPainter& PainterOf(const std::shared_ptr<const TeamMap>& map);
  MapStatus StatusOfMaps() const;

  const TeamServiceOptions options_;
  const SinkList<TeamSink> sinks_;
  TeamAtlas atlas_;
  MapMerger merger_;
  std::vector<TeamScan> offered_;  // Scans from the journal, until the start.
  std::atomic<std::uint64_t> taken_in_ = 0;
  std::atomic<std::uint64_t> duplicates_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;

  // The task that paints alone uses these, while it runs.
  std::map<std::shared_ptr<const TeamMap>, MapPainter> painters_;
  std::chrono::steady_clock::time_point maps_told_{};
  std::chrono::steady_clock::time_point maps_repeated_{};

  SessionHost<RobotSession> host_;  // Its threads use all members above.
  EpochIntake epochs_{[this](const TeamEpoch& epoch) { atlas_.TakeIn(epoch); }};
  std::unique_ptr<PeriodicTask> merging_;
};

}  // namespace qwsm::team
