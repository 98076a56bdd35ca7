// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/team/marks/mark_book.hpp"
#include "service/team/service/team_service.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::pipeline {

struct TeamResultsOptions {
  OccupancyGridOptions rendering;
  bool corrects = true;  ///< Whether the service corrects its maps.
};

/// Leaves what `qwsm map` leaves, for every robot of a team: answers and tables as it goes, at the
/// end the maps, corrected once more, paths in them, loops and pictures, each map with the paths of
/// all where several are in it. A robot without a namespace has the folder itself, others a folder
/// of their name in it.
///
/// Where the disk is full the results end there, with a message; the service goes on.
class TeamResults final : public team::TeamSink {
 public:
  TeamResults(const ResultsFolder& folder, const TeamResultsOptions& options);
  ~TeamResults() override;

  void TakeAnswer(const team::RobotAnswer& answer) override;

  /// Writes what can only be known at the end, on all cores, for who stops a service waits.
  /// @pre the service has stopped.
  /// @throws io::WriteError.
  void Finish(team::TeamService& service);
  /// The marks on the maps as they are in the end. @pre Finish() is done.
  std::vector<team::Mark> Placed(std::span<const team::Mark> marks) const;

 private:
  class RobotResults;
  struct FinalMap;

  RobotResults& ResultsOf(const std::string& robot);
  FinalMap FinishMap(team::TeamService& service,
                     std::string_view robot,
                     const std::filesystem::path& folder) const;

  ResultsFolder folder_;
  TeamResultsOptions options_;
  std::mutex mutex_;  // Guards the list; each robot is answered by one thread at a time.
  std::map<std::string, std::unique_ptr<RobotResults>> robots_;
  std::vector<team::ScanPlace> scans_;  // Where the maps have them in the end.
};

}  // namespace qwsm::pipeline
