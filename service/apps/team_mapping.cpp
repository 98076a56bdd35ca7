// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/team_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "qwsm/mapping/localizer.hpp"
#include "service/apps/output.hpp"
#include "service/apps/saved_map.hpp"
#include "service/apps/teammates.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/atlas/meeting_places.hpp"

namespace qwsm::apps {
namespace {

constexpr const char* kTeamMap = "map.qwsm";

/// A robot that has its place in the map of all, its results not yet finished.
struct MappedRobot {
  std::string name;
  RunSession session;
  std::unique_ptr<pipeline::ResultsWriter> results;
  std::size_t first_scan = 0;          ///< Its first one in the map of all.
  std::vector<StampedAnswer> answers;  ///< Its path in the map of all.
  std::vector<MapEpoch> epochs;        ///< Corrections while it drove.
  Trajectory truth;                    ///< Empty where it is not known.
  ExitCode code = ExitCode::kDone;     ///< How its drive ended.
};

/// The robots of a recording, mapped one after the other, and corrected together.
class TeamMapping {
 public:
  TeamMapping(const RunArguments& arguments,
              const options::ProgramOptions& options,
              const RunSession& session)
      : arguments_(arguments), options_(options), session_(session), marks_(arguments.logs) {}

  ExitCode Follow(const std::vector<std::string>& robots) {
    const ExitCode code = FollowFirst(robots.front());
    if (code != ExitCode::kDone) return code;
    return FollowOthers({robots.begin() + 1, robots.end()});
  }

  /// Corrects paths and map, and leaves the results of all.
  void Finish(const std::optional<std::filesystem::path>& save_map) {
    const std::vector<team::Mark> marks =
        Corrects(options_) ? FinishCorrected() : FinishAsAnswered();
    if (const auto grid = pipeline::RenderOrWarn(map_, options_.rendering)) {
      io::WriteRosMap(session_.folder() / "map.yaml", *grid);
      if (session_.has_pictures()) io::WriteMapPicture(session_.folder() / "map.png", *grid);
    }
    pipeline::WriteMarks(session_.folder().path(), marks);
    pipeline::SaveMap(session_.folder() / kTeamMap, map_, marks);
    if (save_map) pipeline::SaveMap(*save_map, map_, marks);
  }

 private:
  ExitCode FollowFirst(const std::string& name) {
    const auto source = Open(name);
    MappedRobot robot = Begin(name);
    const pipeline::ReplayResult end =
        Corrects(options_) ? FollowCorrecting(*source, robot) : FollowIncrementally(*source, robot);
    Keep(std::move(robot), *source, end);
    return Conclude(end);
  }

  pipeline::ReplayResult FollowIncrementally(pipeline::ScanSource& source, MappedRobot& robot) {
    Mapper mapper(options_.mapper);
    const auto end = robot.session.Run("map",
                                       source,
                                       WithoutTeammates(std::bind_front(&Mapper::Process, &mapper)),
                                       {robot.results.get(), &marks_});
    map_ = mapper.map();
    robot.answers = pipeline::AnswersOf(robot.results->path());
    return end;
  }

  /// The others are looked for in a map that is corrected.
  pipeline::ReplayResult FollowCorrecting(pipeline::ScanSource& source, MappedRobot& robot) {
    pipeline::ShareMemoryAmongThreads();
    SelfCorrectingMapper mapper(options_.mapper, pipeline::BeginOnAnotherThread);
    const auto end = robot.session.Run(
        "map",
        source,
        WithoutTeammates(std::bind_front(&SelfCorrectingMapper::Process, &mapper)),
        {robot.results.get(), &marks_});
    pipeline::CorrectedRun corrected = pipeline::CorrectAtTheEnd(mapper);
    map_ = std::move(corrected.map);
    robot.answers = pipeline::AnswersOf(robot.results->path());
    for (std::size_t i = 0; i < robot.answers.size(); ++i) {
      robot.answers[i].map_robot = corrected.correction.map_robot[i];
    }
    robot.epochs = std::move(corrected.epochs);
    return end;
  }

  /// Those who have been where the first one has, or others of them.
  ExitCode FollowOthers(std::vector<std::string> robots) {
    std::vector<ScanMap> maps{map_};
    for (const std::string& name : robots) {
      const ExitCode code = MapAlone(name, maps.emplace_back());
      if (code != ExitCode::kDone) return code;
    }
    messages::Info("looking for where they meet");
    for (const team::MeetingPlace& place : team::FindMeetingPlaces(maps, options_.mapper)) {
      const RelevantScan& first = maps[place.map].scans().front();
      const ExitCode code = FollowInMap(robots[place.map - 1], place.first_map * first.map_robot);
      if (code != ExitCode::kDone && code != ExitCode::kFailed) return code;
    }
    std::erase_if(robots, [this](const std::string& name) { return IsMapped(name); });
    for (const std::string& name : robots) {
      messages::Error("{0}: is not in the map of the others; --robot {0} maps it alone", name);
    }
    const bool all_are_done = std::ranges::all_of(
        robots_, [](const MappedRobot& robot) { return robot.code == ExitCode::kDone; });
    return robots.empty() && all_are_done ? ExitCode::kDone : ExitCode::kFailed;
  }

  /// @param map what the robot maps by itself, in a frame of its own.
  ExitCode MapAlone(const std::string& name, ScanMap& map) const {
    messages::Info("mapping {} alone", name);
    io::LogOptions log = LogOptionsOf(LogOf(name));
    log.on_fault = {};  // Faults are told when the robot is mapped with the others.
    pipeline::LogSource source(arguments_.logs, log, options_.log.mirrored);
    SelfCorrectingMapper mapper(options_.mapper, pipeline::BeginOnAnotherThread);
    const pipeline::ReplayResult end = session_.LookThrough(
        "map", source, WithoutTeammates(std::bind_front(&SelfCorrectingMapper::Process, &mapper)));
    map = pipeline::CorrectAtTheEnd(mapper).map;
    return end.end == pipeline::ReplayEnd::kInterrupted ? ExitCode::kInterrupted : ExitCode::kDone;
  }

  ExitCode FollowInMap(const std::string& name, const UncertainPose2& start) {
    const auto source = Open(name);
    MappedRobot robot = Begin(name);
    robot.first_scan = map_.scans().size();
    Localizer localizer(options_.mapper, std::move(map_), start);
    pipeline::LostAndFound lost_and_found(localizer, {robot.results.get()});
    const pipeline::ReplayResult end =
        robot.session.Run("map",
                          *source,
                          WithoutTeammates(std::bind_front(&Localizer::Process, &localizer)),
                          {&lost_and_found});
    map_ = localizer.map();
    robot.answers = pipeline::AnswersOf(robot.results->path());
    robot.code = ConcludeDrive(end, localizer, lost_and_found);
    const ExitCode code = robot.code;
    const bool was_found = !robot.answers.empty();
    if (was_found) Keep(std::move(robot), *source, end);
    return code;
  }

  options::LogOptions LogOf(const std::string& robot) const {
    options::LogOptions log = options_.log;
    log.robot = robot;
    return log;
  }

  std::unique_ptr<pipeline::LogSource> Open(const std::string& robot) const {
    return OpenLogs(arguments_, LogOf(robot));
  }

  MappedRobot Begin(const std::string& name) const {
    messages::Info("mapping {}", name);
    MappedRobot robot{.name = name,
                      .session = session_.Part(name),
                      .results = {},
                      .answers = {},
                      .epochs = {},
                      .truth = {}};
    robot.results = std::make_unique<pipeline::ResultsWriter>(
        robot.session.folder(),
        pipeline::ResultsOptions{
            .trajectory = Corrects(options_) ? "trajectory_live.tum" : "trajectory.tum",
            .pictures = session_.has_pictures()});
    return robot;
  }

  void Keep(MappedRobot robot,
            const pipeline::ScanSource& source,
            const pipeline::ReplayResult& end) {
    robot.results->SetTitle(robot.session.Title("map", end));
    robot.truth = source.truth();
    robots_.push_back(std::move(robot));
  }

  bool IsMapped(const std::string& name) const {
    return std::ranges::find(robots_, name, &MappedRobot::name) != robots_.end();
  }

  std::vector<team::Mark> FinishAsAnswered() {
    for (MappedRobot& robot : robots_) {
      robot.results->Finish(map_, options_.mapper.matcher, options_.rendering, robot.truth);
      Summarize(robot, map_);
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
    pipeline::CorrectedRun run{
        .correction = std::move(joint.correction), .map = std::move(joint.map), .epochs = {}};
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      MappedRobot& robot = robots_[i];
      run.correction.map_robot = joint.map_robot[i];
      run.epochs = std::move(robot.epochs);
      robot.results->Finish(map_, options_.mapper.matcher, run, options_.rendering, robot.truth);
      Summarize(robot, run.map);
    }
    map_ = std::move(run.map);
    return marks_.Placed(joint.map_robot.front());
  }

  void Summarize(const MappedRobot& robot, const ScanMap& map) const {
    if (!arguments_.verbosity.quiet) Print("{}\n", robot.name);
    robot.session.Summarize(*robot.results, map);
  }

  const RunArguments& arguments_;
  const options::ProgramOptions& options_;
  const RunSession& session_;
  pipeline::JournalMarks marks_;
  ScanMap map_;
  std::vector<MappedRobot> robots_;
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
  const ExitCode code = mapping.Follow(team.robots);
  mapping.Finish(team.save_map);
  if (!arguments.verbosity.quiet) Print("results        {}\n", session.folder().path().string());
  return code;
}

}  // namespace qwsm::apps
