// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/team_mapping.hpp"

#include <fmt/format.h>

#include <utility>

#include "service/apps/output.hpp"
#include "service/apps/saved_map.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

constexpr const char* kTeamMap = "map.qwsm";

/// The robots of a recording, mapped one after the other.
class TeamMapping {
 public:
  TeamMapping(const RunArguments& arguments,
              const options::ProgramOptions& options,
              const RunSession& session)
      : arguments_(arguments),
        options_(options),
        session_(session),
        map_file_(session.folder() / kTeamMap) {}

  ExitCode Map(const RecordedTeam& team) {
    const std::string& first = team.robots.front();
    TellTurn(first);
    const ExitCode code = team.map_alone(*Open(first), session_.Part(first), map_file_);
    if (code != ExitCode::kDone) return code;
    return MapOthers({team.robots.begin() + 1, team.robots.end()});
  }

  /// The map of all.
  ScanMap map() const { return io::LoadMap(map_file_); }
  /// What is marked on it.
  std::vector<team::Mark> marks() const { return pipeline::MarksOfMap(map_file_); }

 private:
  /// Tries again who was not found while the map grows: a robot may have been where only those
  /// have been that come after it.
  ExitCode MapOthers(std::vector<std::string> robots) const {
    for (bool has_grown = true; has_grown && !robots.empty();) {
      std::vector<std::string> waiting;
      for (const std::string& robot : robots) {
        const ExitCode code = MapInMap(robot);
        if (code == ExitCode::kFailed) {
          waiting.push_back(robot);
        } else if (code != ExitCode::kDone) {
          return code;
        }
      }
      has_grown = waiting.size() < robots.size();
      robots = std::move(waiting);
    }
    for (const std::string& robot : robots) {
      messages::Error("{0}: is not in the map of the others; --robot {0} maps it alone", robot);
    }
    return robots.empty() ? ExitCode::kDone : ExitCode::kFailed;
  }

  ExitCode MapInMap(const std::string& robot) const {
    TellTurn(robot);
    options::ProgramOptions options = options_;
    KnownMap known = OpenMap(map_file_);
    options.mapper.map = known.map.options();
    Localizer localizer(options.mapper, std::move(known.map));
    pipeline::JournalMarks marks({}, known.marks);
    const ExitCode code =
        FollowInMap("map", {localizer, marks}, *Open(robot), options, session_.Part(robot));
    if (code == ExitCode::kDone) pipeline::SaveMap(map_file_, localizer.map(), marks.Placed({}));
    return code;
  }

  std::unique_ptr<pipeline::LogSource> Open(const std::string& robot) const {
    options::LogOptions log = options_.log;
    log.robot = robot;
    return OpenLogs(arguments_, log);
  }

  void TellTurn(const std::string& robot) const {
    messages::Info("mapping {}", robot);
    if (!arguments_.verbosity.quiet) Print("{}\n", robot);
  }

  const RunArguments& arguments_;
  const options::ProgramOptions& options_;
  const RunSession& session_;
  std::filesystem::path map_file_;
};

}  // namespace

ExitCode MapTeam(const RunArguments& arguments,
                 const options::ProgramOptions& options,
                 const RecordedTeam& team) {
  if (arguments.dry_run) {
    return TellPlan(fmt::format("map {} of", fmt::join(team.robots, ", ")), arguments);
  }
  const RunSession session(arguments, options);
  messages::Info("several robots are mapped as a team; --robot NAME maps one of them");
  TeamMapping mapping(arguments, options, session);
  const ExitCode code = mapping.Map(team);
  const ScanMap map = mapping.map();
  if (const auto grid = pipeline::RenderOrWarn(map, options.rendering)) {
    io::WriteRosMap(session.folder() / "map.yaml", *grid);
    io::WriteMapPicture(session.folder() / "map.png", *grid);
  }
  if (team.save_map) pipeline::SaveMap(*team.save_map, map, mapping.marks());
  if (!arguments.verbosity.quiet) Print("results        {}\n", session.folder().path().string());
  return code;
}

}  // namespace qwsm::apps
