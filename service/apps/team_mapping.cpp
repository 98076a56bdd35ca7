// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/team_mapping.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "service/apps/output.hpp"
#include "service/apps/teammates.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/team_picture.hpp"
#include "service/pipeline/results/journal_marks.hpp"
#include "service/pipeline/results/kept_steps.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/atlas/meeting_places.hpp"

namespace qwsm::apps {
namespace {

constexpr const char* kTeamMap = "map.qwsm";

/// What a robot has mapped alone, its results not yet finished.
struct MappedRobot {
  std::string name;
  RunSession session;
  std::unique_ptr<pipeline::ResultsWriter> results;
  std::unique_ptr<pipeline::KeptSteps> steps;
  ScanMap map;                         ///< In a frame of its own.
  pipeline::CorrectedRun alone;        ///< How that was corrected; its scans are the map's.
  std::size_t first_scan = 0;          ///< Its first one in the map of all.
  std::vector<StampedAnswer> answers;  ///< Its path in the map of all.
  Trajectory truth;                    ///< Empty where it is not known.
};

/// The robots of a recording: each maps alone, their maps are joined where they go together, and
/// corrected as one.
class TeamMapping {
 public:
  TeamMapping(const RunArguments& arguments,
              const options::ProgramOptions& options,
              const RunSession& session)
      : arguments_(arguments), options_(options), session_(session), marks_(arguments.logs) {}

  /// Maps all robots, and leaves the results of all.
  ExitCode Map(const std::vector<std::string>& names,
               const std::optional<std::filesystem::path>& save_map) {
    ExitCode code = MapEachAlone(names);
    std::vector<MappedRobot> apart = JoinMaps(code);
    const std::vector<team::Mark> marks =
        Corrects(options_) ? FinishCorrected() : FinishAsAnswered();
    WriteMap(marks, save_map);
    const auto tell = [&](const std::string& name, std::string_view what) {
      messages::Error("{}: {}", name, what);
      if (code == ExitCode::kDone) code = ExitCode::kFailed;
    };
    for (MappedRobot& robot : apart) {
      FinishAlone(robot);
      if (robot.map.empty()) continue;
      tell(robot.name, "is not in the map of the others, but in one of its own");
    }
    for (const std::string& name : blind_) tell(name, "has seen nothing, and is in no map");
    return session_.is_interrupted() ? ExitCode::kInterrupted : code;
  }

 private:
  /// Goes on without a robot of whose scans none can be used. @throws UsageError where that is all.
  ExitCode MapEachAlone(const std::vector<std::string>& names) {
    ExitCode code = ExitCode::kDone;
    for (const std::string& name : names) {
      messages::Info("mapping {}", name);
      options::LogOptions log = options_.log;
      log.robot = name;
      std::unique_ptr<pipeline::LogSource> source;
      try {
        source = OpenLogs(arguments_, log);
      } catch (const UsageError& error) {
        if (robots_.empty() && name == names.back()) throw;
        messages::Error("{}: is not mapped: {}", name, error.what());
        code = ExitCode::kFailed;
        continue;
      }
      const ExitCode end = MapAlone(name, *source);
      if (end != ExitCode::kDone) return end;
    }
    return code;
  }

  ExitCode MapAlone(const std::string& name, pipeline::LogSource& source) {
    MappedRobot robot = Begin(name);
    const std::vector<pipeline::StepSink*> sinks{robot.steps.get()};
    const pipeline::ReplayResult end = Corrects(options_) ? MapCorrecting(source, sinks, robot)
                                                          : MapIncrementally(source, sinks, robot);
    robot.results->SetTitle(robot.session.Title("map", end));
    robot.truth = source.truth();
    if (end.end == pipeline::ReplayEnd::kExhausted && robot.map.empty()) {
      blind_.push_back(name);
    }
    robots_.push_back(std::move(robot));
    return session_.Conclude(end);
  }

  MappedRobot Begin(const std::string& name) const {
    MappedRobot robot{.name = name,
                      .session = session_.Part(name),
                      .results = {},
                      .steps = std::make_unique<pipeline::KeptSteps>(),
                      .map = ScanMap(),
                      .alone = {.correction = {}, .scans = {}, .answered_in = {}, .epochs = {}},
                      .answers = {},
                      .truth = {}};
    robot.results = std::make_unique<pipeline::ResultsWriter>(
        robot.session.folder(),
        pipeline::ResultsOptions{.trajectory = Corrects(options_)
                                                   ? pipeline::ResultFile::kLiveTrajectory
                                                   : pipeline::ResultFile::kTrajectory,
                                 .pictures = session_.has_pictures()});
    return robot;
  }

  static pipeline::ReplayResult Feed(const RunSession& session,
                                     pipeline::ScanSource& source,
                                     pipeline::Answer answer,
                                     std::vector<pipeline::StepSink*> sinks) {
    return session.Run(
        "map",
        source,
        {{.answer = WithoutTeammates(std::move(answer)), .sinks = std::move(sinks)}});
  }

  pipeline::ReplayResult MapIncrementally(pipeline::ScanSource& source,
                                          std::vector<pipeline::StepSink*> sinks,
                                          MappedRobot& robot) const {
    Mapper mapper(options_.mapper);
    const auto end =
        Feed(robot.session, source, std::bind_front(&Mapper::Process, &mapper), std::move(sinks));
    robot.map = mapper.map();
    return end;
  }

  pipeline::ReplayResult MapCorrecting(pipeline::ScanSource& source,
                                       std::vector<pipeline::StepSink*> sinks,
                                       MappedRobot& robot) const {
    pipeline::ShareMemoryAmongThreads();
    SelfCorrectingMapper mapper(options_.mapper, pipeline::BeginOnAnotherThread);
    const auto end = Feed(robot.session,
                          source,
                          std::bind_front(&SelfCorrectingMapper::Process, &mapper),
                          std::move(sinks));
    robot.alone = pipeline::CorrectAtTheEnd(mapper);
    robot.map = MapOf(std::exchange(robot.alone.scans, {}), options_.mapper.map);
    return end;
  }

  /// Joins the maps of all who have been where the first robot has, or others of them.
  /// @param code of mapping; once it is interrupted, nobody is looked for any more.
  /// @return the robots that have not, or were not found.
  std::vector<MappedRobot> JoinMaps(ExitCode& code) {
    messages::Info("looking for where robots have met");
    const pipeline::Interruption interruption(
        "interrupted: who was not found yet stays in a map of its own; again to quit at once\n");
    const auto is_interrupted = [&] {
      if (interruption.requested()) code = ExitCode::kInterrupted;
      return code == ExitCode::kInterrupted;
    };
    std::vector<const ScanMap*> maps;
    for (const MappedRobot& robot : robots_) maps.push_back(&robot.map);
    team::MetMaps met = team::FindMeetingPlaces(maps, options_.mapper, is_interrupted);
    map_ = std::move(met.map);
    std::vector<MappedRobot> joined;
    std::size_t first_scan = 0;
    for (const team::MeetingPlace& place : met.places) {
      MappedRobot& robot = joined.emplace_back(std::move(robots_[place.map]));
      std::vector<pipeline::StepSink*> sinks{robot.results.get()};
      if (joined.size() == 1) sinks.push_back(&marks_);  // Whose moments are the first robot's.
      PlaceAnswers(place.first_map, robot, sinks);
      robot.first_scan = std::exchange(first_scan, first_scan + robot.map.scans().size());
    }
    std::erase_if(robots_, [](const MappedRobot& robot) { return robot.results == nullptr; });
    std::swap(robots_, joined);
    return joined;
  }

  /// Of a corrected map, where the path ended up in it.
  static void PlaceAnswers(const UncertainPose2& map_own,
                           MappedRobot& robot,
                           std::span<pipeline::StepSink* const> sinks) {
    robot.steps->PassOn(map_own, sinks);
    robot.answers = pipeline::AnswersOf(robot.results->path());
    const std::vector<UncertainPose2>& corrected = robot.alone.correction.map_robot;
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      robot.answers[i].map_robot = map_own * corrected[i];
    }
    for (MapEpoch& epoch : robot.alone.epochs) {
      for (UncertainPose2& map_node : epoch.map_node) map_node = map_own * map_node;
    }
  }

  /// The map lies in the world as its first robot began, for all in it.
  void ShareWorld(const MappedRobot& robot) const {
    const std::optional<Pose2>& T_world_map = robots_.front().results->T_world_map();
    if (T_world_map) robot.results->SetMapInWorld(*T_world_map);
  }

  std::vector<team::Mark> FinishAsAnswered() {
    for (const MappedRobot& robot : robots_) {
      ShareWorld(robot);
      robot.results->Finish(map_, options_.mapper.matcher, options_.rendering, robot.truth);
      Summarize(robot);
    }
    return marks_.Placed({});
  }

  /// Leaves the map that is corrected, and the results of the robots in it.
  /// @return what is marked on it.
  std::vector<team::Mark> FinishCorrected() {
    std::vector<DriveInMap> drives;
    for (const MappedRobot& robot : robots_) {
      drives.push_back({.first_scan = robot.first_scan, .answers = robot.answers});
    }
    JointCorrection joint = CorrectJointly(map_, drives, options_.mapper);
    pipeline::CorrectedRun run{.correction = std::move(joint.correction),
                               .scans = std::move(joint.scans),
                               .answered_in = pipeline::FiguresOf(map_),
                               .epochs = {}};
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      MappedRobot& robot = robots_[i];
      run.correction.map_robot = joint.map_robot[i];
      run.epochs = std::move(robot.alone.epochs);
      ShareWorld(robot);
      robot.results->Finish(
          map_.scans(), options_.mapper.matcher, run, options_.rendering, robot.truth);
      Summarize(robot);
      for (std::size_t k = 0; k < robot.answers.size(); ++k) {
        robot.answers[k].map_robot = run.correction.map_robot[k];
      }
    }
    map_ = MapOf(std::move(run.scans), options_.mapper.map);
    return marks_.Placed(joint.map_robot.front());
  }

  /// Leaves the results of a robot in a map of its own.
  void FinishAlone(MappedRobot& robot) const {
    PlaceAnswers({}, robot, std::array<pipeline::StepSink*, 1>{robot.results.get()});
    const ScanMap& map = robot.map;
    if (Corrects(options_)) {
      robot.alone.scans.assign(map.scans().begin(), map.scans().end());
      robot.results->Finish(
          map.scans(), options_.mapper.matcher, robot.alone, options_.rendering, robot.truth);
    } else {
      robot.results->Finish(map, options_.mapper.matcher, options_.rendering, robot.truth);
    }
    Summarize(robot);
  }

  void WriteMap(const std::vector<team::Mark>& marks,
                const std::optional<std::filesystem::path>& save_map) const {
    if (const auto grid = pipeline::RenderOrWarn(map_.scans(), options_.rendering)) {
      io::WriteRosMap(session_.folder() / pipeline::ResultFile::kMap, *grid);
      if (session_.has_pictures()) {
        io::WriteTeamPicture(session_.folder() / pipeline::ResultFile::kMapPicture, *grid, Paths());
      }
    }
    pipeline::WriteMarks(session_.folder().path(), marks);
    pipeline::SaveMap(session_.folder() / kTeamMap, map_, marks);
    if (save_map) pipeline::SaveMap(*save_map, map_, marks);
  }

  std::vector<io::RobotPath> Paths() const {
    std::vector<io::RobotPath> paths;
    for (const MappedRobot& robot : robots_) {
      Trajectory path;
      for (const auto& [stamp, map_robot] : robot.answers) path.push_back({stamp, map_robot.T_a_b});
      paths.push_back({.robot = robot.name, .path = std::move(path)});
    }
    return paths;
  }

  void Summarize(const MappedRobot& robot) const {
    if (!arguments_.verbosity.quiet) Print("{}\n", robot.name);
    robot.session.Summarize(*robot.results);
  }

  const RunArguments& arguments_;
  const options::ProgramOptions& options_;
  const RunSession& session_;
  pipeline::JournalMarks marks_;
  ScanMap map_;
  std::vector<MappedRobot> robots_;
  std::vector<std::string> blind_;  // Whose scans are all without readings.
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
  const ExitCode code = TeamMapping(arguments, options, session).Map(team.robots, team.save_map);
  if (!arguments.verbosity.quiet) Print("results        {}\n", session.folder().path().string());
  return code;
}

}  // namespace qwsm::apps
