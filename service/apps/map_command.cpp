// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/output_check.hpp"
#include "service/apps/page.hpp"
#include "service/apps/run_session.hpp"
#include "service/apps/saved_map.hpp"
#include "service/apps/scenario_arguments.hpp"
#include "service/apps/team_mapping.hpp"
#include "service/apps/teammates.hpp"
#include "service/config/suggestion.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/live/live_run.hpp"
#include "service/pipeline/results/answer_bag.hpp"
#include "service/pipeline/results/corrected_run.hpp"
#include "service/pipeline/results/journal_marks.hpp"
#include "service/pipeline/results/loss_teller.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/results/marks_of_map.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/run/parallel.hpp"
#include "service/pipeline/simulation/simulator_source.hpp"

namespace qwsm::apps {
namespace {

using pipeline::RenderOrWarn;
using pipeline::ResultFile;

struct MapArguments {
  RunArguments run;
  std::optional<std::string> matcher;
  std::optional<std::filesystem::path> save_map;
  std::optional<std::filesystem::path> continued;  ///< Map to go on with.
  bool bag = false;                                ///< Whether the answers are left as a bag, too.
  bool view = false;                               ///< Whether it is shown in a browser.
  ScenarioArguments simulated;                     ///< Instead of logs, if it names a scenario.
  std::optional<std::string> robot;

  bool is_simulated() const { return !simulated.scenario.empty(); }
};

options::ProgramOptions LoadOptions(const MapArguments& arguments) {
  auto options = config::LoadOptions<options::ProgramOptions>(arguments.run.sources);
  if (arguments.robot && !arguments.is_simulated()) options.log.robot = *arguments.robot;
  if (arguments.matcher) options.mapper.matcher = MatcherNamed(*arguments.matcher);
  const bool needs_all_scans = arguments.save_map || arguments.continued;
  if (needs_all_scans && options.mapper.matcher != MatcherKind::kQWsm) {
    throw UsageError(
        "--save-map and --continue need the matcher q-wsm: the others forget what they have seen");
  }
  return options;
}

void CheckSource(const MapArguments& arguments) {
  if (arguments.is_simulated() != arguments.run.logs.empty()) {
    throw UsageError("map needs either logs or --sim SCENARIO");
  }
  if (arguments.continued && arguments.bag) {
    throw UsageError(
        "--bag does not go with --continue: where the robot starts is found out later");
  }
  if (arguments.continued && arguments.view) {
    throw UsageError(
        "--view does not go with --continue: where the robot starts is found out later");
  }
  const ScenarioArguments& simulated = arguments.simulated;
  if (!arguments.is_simulated() && (simulated.seed || simulated.duration_s)) {
    throw UsageError("--seed and --duration belong to --sim SCENARIO");
  }
}

/// Of the robot of that name, or of the first one.
std::size_t RobotNamed(const std::optional<std::string>& name,
                       const sim::ScenarioOptions& scenario) {
  if (!name) return 0;
  std::vector<std::string> names;
  for (const sim::RobotOptions& robot : scenario.robots) names.push_back(robot.name);
  const auto found = std::ranges::find(names, *name);
  if (found == names.end()) {
    throw UsageError(fmt::format("--robot: the scenario has {}, not '{}'{}",
                                 fmt::join(names, ", "),
                                 *name,
                                 config::DidYouMean(*name, names)));
  }
  return static_cast<std::size_t>(found - names.begin());
}

/// Where the scans come from; of a simulation, the scenario too.
struct Origin {
  std::unique_ptr<pipeline::ScanSource> source;
  std::optional<sim::ScenarioOptions> scenario;
};

Origin OpenOrigin(const MapArguments& arguments, const options::LogOptions& log) {
  if (!arguments.is_simulated()) return {.source = OpenLogs(arguments.run, log), .scenario = {}};
  const sim::ScenarioOptions scenario = LoadScenario(arguments.simulated);
  const std::size_t robot = RobotNamed(arguments.robot, scenario);
  return {.source = std::make_unique<pipeline::SimulatorSource>(scenario, robot),
          .scenario = scenario};
}

/// The page of the run; null where nobody wants to look.
std::unique_ptr<pipeline::LiveRun> ShowLive(const MapArguments& arguments,
                                            const options::ProgramOptions& options) {
  if (!arguments.view) return nullptr;
  const std::string name = arguments.is_simulated()
                               ? arguments.simulated.scenario
                               : arguments.run.logs.front().filename().string();
  auto live = std::make_unique<pipeline::LiveRun>(options, "qwsm map " + name);
  TellPage(live->url(), !arguments.run.verbosity.quiet && !arguments.run.verbosity.json);
  return live;
}

/// The marks of a log, and those that were set on the page of the run, if there is one.
std::vector<team::Mark> WithThoseOfPage(std::vector<team::Mark> marks,
                                        const pipeline::LiveRun* live) {
  if (live != nullptr) std::ranges::move(live->marks(), std::back_inserter(marks));
  return marks;
}

/// Leaves what is marked on the map among the results, and both where the map is to be saved.
void KeepMap(const MapArguments& arguments,
             const RunSession& session,
             const ScanMap& map,
             const std::vector<team::Mark>& marks) {
  pipeline::WriteMarks(session.folder().path(), marks);
  if (arguments.save_map) pipeline::SaveMap(*arguments.save_map, map, marks);
}

constexpr const char* kAtEnd = "the log is at its end";

/// Answers a scan, and tells what became of robot and map.
MappingStep AnswerAndTell(const Observation& observation,
                          SelfCorrectingMapper& mapper,
                          pipeline::LossTeller& losses,
                          pipeline::LiveRun* live) {
  const std::size_t epochs = mapper.epochs().size();
  MappingStep step = mapper.Process(observation);
  losses.Take(step);
  if (live != nullptr && mapper.epochs().size() > epochs) {
    live->Correct(mapper.epochs().back(), mapper.mapper().map().scans());
  }
  return step;
}

/// Writes what can only be known at the end.
void FinishResults(const Mapper& mapper,
                   const std::optional<pipeline::CorrectedRun>& corrected,
                   const OccupancyGridOptions& rendering,
                   const Trajectory& truth,
                   pipeline::ResultsWriter& results) {
  const MatcherKind matcher = mapper.options().matcher;
  if (corrected) {
    results.Finish(mapper.map().scans(), matcher, *corrected, rendering, truth);
  } else {
    results.Finish(mapper.map(), matcher, rendering, truth);
  }
}

ExitCode MapAll(const MapArguments& arguments,
                const options::ProgramOptions& options,
                pipeline::ScanSource& source,
                const RunSession& session) {
  std::optional<SelfCorrectingMapper> correcting;
  std::optional<pipeline::LossTeller> losses;
  if (Corrects(options)) {
    // Corrected maps, larger than all else, are made on another thread.
    pipeline::ShareMemoryAmongThreads();
    correcting.emplace(options.mapper, pipeline::BeginOnAnotherThread);
    losses.emplace(*correcting);
  }
  Mapper incremental(options.mapper);
  pipeline::ResultsWriter results(
      session.folder(),
      {.trajectory = correcting ? ResultFile::kLiveTrajectory : ResultFile::kTrajectory,
       .pictures = session.has_pictures()});
  pipeline::AnswerBag answers;
  pipeline::JournalMarks marks(arguments.run.logs);
  std::vector<pipeline::StepSink*> sinks{&results, &marks};
  const std::unique_ptr<pipeline::LiveRun> live = ShowLive(arguments, options);
  if (live) sinks.push_back(live.get());
  if (arguments.bag) sinks.push_back(&answers);
  pipeline::Answer answer = [&](const Observation& observation) {
    return correcting ? AnswerAndTell(observation, *correcting, *losses, live.get())
                      : incremental.Process(observation);
  };
  if (arguments.robot) answer = WithoutTeammates(std::move(answer));
  const pipeline::ReplayResult end = session.Run("map", source, answer, sinks);
  results.SetTitle(session.Title("map", end));

  const Mapper& mapper = correcting ? correcting->mapper() : incremental;
  std::optional<pipeline::CorrectedRun> corrected;
  if (correcting) {
    losses->Finish();
    corrected = pipeline::CorrectAtTheEnd(*correcting);
    if (arguments.bag) answers.Correct(corrected->correction.map_robot);
  }
  FinishResults(mapper, corrected, options.rendering, source.truth(), results);
  const std::span<const RelevantScan> scans = corrected ? corrected->scans : mapper.map().scans();
  if (arguments.bag) {
    answers.Write(session.folder() / ResultFile::kAnswers, RenderOrWarn(scans, options.rendering));
  }
  const std::vector<team::Mark> of_log =
      marks.Placed(corrected ? corrected->correction.map_robot : std::vector<UncertainPose2>());
  if (live && corrected) live->Correct({.map_node = corrected->correction.map_node}, scans);
  if (live) live->Finish(scans, corrected ? "the log is at its end, the map corrected" : kAtEnd);
  std::optional<ScanMap> searchable;  // The corrected one, only where it is to be saved.
  if (arguments.save_map && corrected) searchable = MapOf(corrected->scans, options.mapper.map);
  const ScanMap& map = searchable ? *searchable : mapper.map();
  KeepMap(arguments, session, map, WithThoseOfPage(of_log, live.get()));
  session.Summarize(results);
  const ExitCode code = session.Conclude(end);
  if (live && code == ExitCode::kDone) {
    KeepPage(
        [&live](const pipeline::Interruption& interruption) { live->StayUntil(interruption); });
    KeepMap(arguments, session, map, WithThoseOfPage(of_log, live.get()));
  }
  return code;
}

/// Goes on in a map that was made before, once the robot is recognised in it. Where that is a grid
/// nothing is corrected: nobody drove where its walls are surveyed from.
ExitCode ContinueMap(const MapArguments& arguments,
                     const options::ProgramOptions& options,
                     KnownMap known,
                     pipeline::ScanSource& source,
                     const RunSession& session) {
  Localizer localizer(options.mapper, std::move(known.map));
  if (!Corrects(options) || IsGrid(*arguments.continued)) {
    pipeline::JournalMarks marks(arguments.run.logs, known.marks);
    const ExitCode code = FollowInMap("map", {localizer, marks}, source, options, session);
    if (arguments.save_map) {
      pipeline::SaveMap(*arguments.save_map, localizer.map(), marks.Placed({}));
    }
    return code;
  }
  pipeline::JournalMarks marks(arguments.run.logs);
  ContinuedMap both =
      CorrectAfterFollowing({localizer, marks}, known.marks, source, options, session);
  if (arguments.save_map) {
    const ScanMap map = MapOf(std::move(both.scans), localizer.map().options());
    pipeline::SaveMap(*arguments.save_map, map, both.marks);
  }
  return both.code;
}

/// Maps all robots of a bag. @param several says which.
ExitCode MapRobots(const MapArguments& arguments,
                   const options::ProgramOptions& options,
                   const io::SeveralRobotsError& several) {
  if (arguments.continued || arguments.bag || arguments.view || arguments.run.verbosity.json ||
      options.mapper.matcher != MatcherKind::kQWsm) {
    throw UsageError(
        fmt::format("{}; else they are mapped as a team, with which --continue, --bag, --view, "
                    "--json and other matchers do not go",
                    several.what()));
  }
  return MapTeam(arguments.run, options, {several.robots(), arguments.save_map});
}

ExitCode RunMap(MapArguments arguments) {
  StartMessages(arguments.run.verbosity);
  CheckSource(arguments);
  if (arguments.is_simulated()) {
    arguments.simulated.settings = TakeScenarioSettings(arguments.run.sources.settings);
    arguments.run.scenario = arguments.simulated.scenario;
  }
  options::ProgramOptions options = LoadOptions(arguments);
  if (arguments.save_map) {
    CheckMapToSave(
        *arguments.save_map, arguments.run.logs, arguments.run.output.value_or("results/latest"));
  }
  std::optional<KnownMap> known;
  if (arguments.continued) {
    arguments.run.other_inputs = {*arguments.continued};
    known = OpenMap(*arguments.continued);
    options.mapper.map = known->map.options();
  }
  Origin origin;
  try {
    origin = OpenOrigin(arguments, options.log);
  } catch (const io::SeveralRobotsError& several) {
    return MapRobots(arguments, options, several);
  }
  if (arguments.run.dry_run) {
    if (arguments.is_simulated()) arguments.run.logs = {arguments.simulated.scenario};
    return TellPlan("map", arguments.run);
  }

  const RunSession session(arguments.run, options);
  if (origin.scenario) {
    io::WriteTextFile(session.folder() / ResultFile::kScenario, ScenarioText(*origin.scenario));
  }
  return known ? ContinueMap(arguments, options, *std::move(known), *origin.source, session)
               : MapAll(arguments, options, *origin.source, session);
}

}  // namespace

Command AddMapCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "map", "the robot's path and a map from recorded logs");
  auto arguments = std::make_shared<MapArguments>();
  parser->footer(
      "  qwsm map intel.log.gz                            results in results/latest\n"
      "  qwsm map intel.log --output intel                results in intel/\n"
      "  qwsm map intel.log --matcher wsm                 the incremental baseline\n"
      "  qwsm map intel.log --view                        seen at http://localhost:8765/\n"
      "  qwsm map intel.log --save-map intel.qwsm         to localize in later\n"
      "  qwsm map later.log --continue intel.qwsm --save-map both.qwsm\n"
      "  qwsm map intel.log --set graph.enabled=false     nothing is corrected\n"
      "  qwsm map robot.log --set mapper.motion.rotation_per_rotation=0.5\n"
      "  qwsm map drive.bag                               ROS 1; rosbag2: a folder, .mcap, .db3\n"
      "  qwsm map team                                    all robots of a bag, in one map\n"
      "  qwsm map team --robot robot1 --scan robot1/scan  one of them\n"
      "  qwsm map --sim office --seed 7                   a simulated robot, with the truth\n"
      "  zcat *.log.gz | qwsm map - --quiet               from a pipe");
  AddRunArguments(*parser, arguments->run)->required(false);
  parser->add_option("--matcher", arguments->matcher, "q-wsm, wsm or icp")->type_name("NAME");
  AddNoPictures(*parser, arguments->run.no_pictures);
  parser->add_option("--save-map", arguments->save_map, "the map, for qwsm localize")
      ->type_name("FILE");
  parser
      ->add_option(
          "--continue",
          arguments->continued,
          "go on with a map that was saved, or a map.yaml of ROS, wherever in it the robot "
          "starts; both are corrected together in the end")
      ->type_name("MAP");
  AddViewFlag(*parser, arguments->view);
  parser->add_flag("--bag", arguments->bag, "poses, /tf and map as answers.mcap, too, for ROS 2");
  parser
      ->add_option("--sim",
                   arguments->simulated.scenario,
                   "run this scenario instead of reading logs; --set takes its options, too")
      ->type_name("SCENARIO")
      ->group("Simulation");
  AddScenarioSettings(*parser, arguments->simulated);
  parser->add_option("--robot", arguments->robot, "of several robots, that of this name")
      ->type_name("NAME");
  return {.parser = parser, .run = [arguments] { return RunMap(*arguments); }};
}

}  // namespace qwsm::apps
