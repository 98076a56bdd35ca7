// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/output.hpp"
#include "service/apps/run_session.hpp"
#include "service/apps/scenario_arguments.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/evaluation/experiment_report.hpp"
#include "service/pipeline/simulation/simulator_source.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;
using namespace pipeline;

/// The last one is the baseline of Visser et al. (2009), their incremental WSM.
constexpr std::array kExperimentMatchers = {MatcherKind::kQWsm, MatcherKind::kWsm};

struct ExperimentArguments {
  RunArguments run;
  ScenarioArguments scenario;
  int seeds = 10;
};

/// Everything that came of it so far; each seed has a folder for itself.
struct Experiment {
  std::vector<ExperimentRun> runs;
  ReplayEnd end = ReplayEnd::kExhausted;
};

/// The pictures of one seed under the names in Visser et al. (2009): both maps (Figure 3), both
/// residuals (Figure 4).
void CopyFigures(const fs::path& seed, const fs::path& folder) {
  const auto copy = [&](const fs::path& from, ResultFile to) {
    if (fs::exists(from)) fs::copy_file(from, folder / to, fs::copy_options::overwrite_existing);
  };
  copy(seed / "q-wsm" / ResultFile::kTrajectoryPicture, ResultFile::kFigure3QWsm);
  copy(seed / "wsm" / ResultFile::kTrajectoryPicture, ResultFile::kFigure3Wsm);
  copy(seed / ResultFile::kResiduals, ResultFile::kFigure4);
}

Experiment RunSeeds(const ExperimentArguments& arguments,
                    const options::ProgramOptions& options,
                    const RunSession& session) {
  Experiment experiment;
  sim::ScenarioOptions scenario = LoadScenario(arguments.scenario);
  const int first = scenario.seed;
  for (int i = 0; i < arguments.seeds && experiment.end == ReplayEnd::kExhausted; ++i) {
    scenario.seed = first + i;
    const ResultsFolder folder =
        session.folder().Part(fmt::format("seed-{}", scenario.seed), false);
    io::WriteTextFile(folder / ResultFile::kScenario, ScenarioText(scenario));
    SimulatorSource source(scenario, 0);
    MatcherContest contest(options.mapper, kExperimentMatchers, folder);
    const std::string task = fmt::format("seed {} of {}", i + 1, arguments.seeds);
    experiment.end = session.Run(task, source, contest.runs()).end;
    contest.Finish(options.rendering, source.truth());
    std::ranges::move(RunsOf(contest.contestants(), scenario.seed),
                      std::back_inserter(experiment.runs));
    if (i == 0) CopyFigures(folder.path(), session.folder().path());
  }
  return experiment;
}

ExitCode RunExperiment(ExperimentArguments arguments) {
  StartMessages(arguments.run.verbosity);
  arguments.scenario.settings = TakeScenarioSettings(arguments.run.sources.settings);
  const auto options = config::LoadOptions<options::ProgramOptions>(arguments.run.sources);
  LoadScenario(arguments.scenario);  // So that nothing is left behind where it is wrong.
  if (arguments.run.dry_run) {
    arguments.run.logs = {arguments.scenario.scenario};
    return TellPlan(fmt::format("run {} seeds of", arguments.seeds), arguments.run);
  }

  const RunSession session(arguments.run, options);
  const Experiment experiment = RunSeeds(arguments, options, session);
  const ResultsFolder& folder = session.folder();
  const std::string json = ExperimentJson(experiment.runs);
  io::WriteTextFile(folder / ResultFile::kMetrics, json);
  io::WriteTextFile(folder / ResultFile::kTable, ExperimentCsv(experiment.runs));
  io::WriteTextFile(folder / ResultFile::kTableMarkdown, ExperimentMarkdown(experiment.runs));
  if (arguments.run.verbosity.json) {
    Print("{}", json);
  } else if (!arguments.run.verbosity.quiet) {
    Print("{}\nresults        {}\n", ExperimentText(experiment.runs), folder.path().string());
  }
  return session.Conclude({.end = experiment.end, .failure = {}});
}

}  // namespace

Command AddExperimentCommand(CLI::App& program) {
  CLI::App* parser = AddParser(
      program, "experiment", "the paper's experiment: q-wsm beside wsm on simulated drives");
  auto arguments = std::make_shared<ExperimentArguments>();
  parser->footer(
      "  qwsm experiment park                             ten seeds, results in results/latest\n"
      "  qwsm experiment corridor --seeds 3 -o corridor   figures and tables in corridor/\n"
      "  qwsm experiment park --set ground.everywhere=floor --set "
      "mapper.relevant_translation_m=0.3");
  parser
      ->add_option(
          "SCENARIO",
          arguments->scenario.scenario,
          "a YAML file, or park, corridor, office, rubble, campus, joystick, team or one of its "
          "variants: team_unknown, team_wrong, team_late, team_carried, team_wings, "
          "team_corridor, team_campus")
      ->required()
      ->type_name("");
  AddResultArguments(*parser, arguments->run, "the figures as JSON on standard output");
  parser->add_option("--seeds", arguments->seeds, "how many; each is another place and drive")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str()
      ->type_name("N")
      ->group("Simulation");
  AddScenarioSettings(*parser, arguments->scenario);
  return {.parser = parser, .run = [arguments] { return RunExperiment(*arguments); }};
}

}  // namespace qwsm::apps
