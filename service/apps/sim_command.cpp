// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/apps/page.hpp"
#include "service/apps/scenario_arguments.hpp"
#include "service/apps/version.hpp"
#include "service/config/options_io.hpp"
#include "service/dds/entities/middleware_messages.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/network/network_robot.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/simulation/simulation_report.hpp"
#include "service/pipeline/simulation/simulation_run.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/view/live_view.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;
using namespace pipeline;

struct SimArguments {
  ScenarioArguments scenario;
  std::optional<fs::path> output;
  std::optional<double> real_time_factor;
  std::vector<std::string> network;  ///< `key=value` of dds::NetworkOptions.
  std::vector<std::string> page;     ///< `key=value` of view::ViewOptions.
  bool dds = false;
  bool view = false;
  bool wait_for_answers = false;
  Verbosity verbosity;
  bool force = false;

  bool is_on_network() const { return dds || view; }
};

/// A robot's log must not be what the run says, which would be written over it.
void RefuseNamesOfTheRun(const sim::ScenarioOptions& scenario) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const std::string& name = scenario.robots[i].name;
    if (name + ".log" != NameOf(ResultFile::kLog)) continue;
    throw UsageError(fmt::format(
        "robots[{}].name: '{}' has no log: {}.log is what this run says; call the robot otherwise",
        i,
        name,
        name));
  }
}

SimulatedLogs OpenLogs(const sim::Simulation& simulation, const ResultsFolder& folder) {
  SimulatedLogs logs;
  for (std::size_t i = 0; i < simulation.robots().size(); ++i) {
    const std::string& name = simulation.robots()[i].options().name;
    logs.push_back(std::make_unique<SimulatedLog>(folder.path(), i, name));
  }
  return logs;
}

void Warn(const std::string& text) { messages::Warn(text); }

/// What happens on the network, in a browser.
struct Page {
  Page(const dds::Participant& participant,
       const dds::NetworkOptions& network,
       const view::ViewOptions& options,
       const std::string& name)
      : graph(participant, network),
        marks(participant, refusals, team::MarkJournal({}, Warn)),
        view(participant, graph, options, {.name = name, .marks = marks, .warn = Warn}) {
    marks.Start();
  }

  dds::RosGraph graph;
  dds::Refusals refusals{Warn};
  dds::MarkExchange marks;
  view::LiveView view;
};

/// All robots of a simulation on the network.
class NetworkTeam {
 public:
  NetworkTeam(const SimArguments& arguments, sim::Simulation& simulation)
      : messages_(Warn),
        network_(config::LoadOptions<dds::NetworkOptions>(
            {.file = std::nullopt, .settings = arguments.network})),
        participant_(network_) {
    if (arguments.view) ShowLive(arguments);
    const auto pace = arguments.wait_for_answers ? NetworkPace::kAnswers : NetworkPace::kFree;
    for (std::size_t i = 0; i < simulation.robots().size(); ++i) {
      robots_.push_back(
          std::make_unique<NetworkRobot>(participant_, simulation, i, pace, arguments.view));
    }
    if (arguments.wait_for_answers) WaitForService();
  }

  void AddTo(std::vector<ReadingSink*>& sinks) const {
    for (const auto& robot : robots_) sinks.push_back(robot.get());
  }
  void Finish() const {
    for (const auto& robot : robots_) robot->Finish();
  }

 private:
  void WaitForService() const {
    for (const auto& robot : robots_) {
      if (robot->WaitForListener(std::chrono::seconds(10))) continue;
      throw dds::DdsError(
          fmt::format("no service answers {}; is 'qwsm serve' running in the same DDS domain?",
                      robot->names().Topic(dds::kScanTopic)));
    }
  }

  void ShowLive(const SimArguments& arguments) {
    page_ = std::make_unique<Page>(
        participant_,
        network_,
        config::LoadOptions<view::ViewOptions>({.file = std::nullopt, .settings = arguments.page}),
        "qwsm sim " + arguments.scenario.scenario);
    TellPage(page_->view.url(), !arguments.verbosity.quiet && !arguments.verbosity.json);
  }

  dds::MiddlewareMessages messages_;
  dds::NetworkOptions network_;
  dds::Participant participant_;
  std::unique_ptr<Page> page_;  // Null where nobody wants to look.
  std::vector<std::unique_ptr<NetworkRobot>> robots_;
};

ExitCode RunSim(const SimArguments& arguments) {
  StartMessages(arguments.verbosity);
  if (!arguments.network.empty() && !arguments.is_on_network()) {
    throw UsageError("--network needs --dds or --view: without, nothing is published");
  }
  const sim::ScenarioOptions scenario = LoadScenario(arguments.scenario);
  RefuseNamesOfTheRun(scenario);
  sim::Simulation simulation(scenario);
  const ResultsFolder folder = arguments.output ? ResultsFolder(*arguments.output, arguments.force)
                                                : ResultsFolder::ForNow("results");
  CopyMessagesTo(folder / ResultFile::kLog);
  messages::Info("version {}", Version());
  io::WriteTextFile(folder / ResultFile::kScenario, ScenarioText(scenario));

  const SimulatedLogs logs = OpenLogs(simulation, folder);
  SimulationProgress progress(simulation,
                              arguments.verbosity.quiet ? ProgressStyle::kNone : StyleFor(stderr));
  Pacer pacer(arguments.real_time_factor.value_or(1.0));
  std::vector<ReadingSink*> sinks{&progress};
  for (const auto& log : logs) sinks.push_back(log.get());
  const bool is_live = arguments.is_on_network() && !arguments.wait_for_answers;
  if (arguments.real_time_factor || is_live) sinks.push_back(&pacer);
  std::optional<NetworkTeam> team;
  if (arguments.is_on_network()) team.emplace(arguments, simulation).AddTo(sinks);
  const Interruption interruption;
  const bool is_complete =
      RunSimulation(simulation, sinks, [&] { return interruption.requested(); });
  progress.Clear();
  if (team) team->Finish();

  for (std::size_t i = 0; i < logs.size(); ++i) {
    logs[i]->Commit();
    WriteWorldPicture(folder / (simulation.robots()[i].options().name + ".png"),
                      simulation.scenery(),
                      logs[i]->paths());
  }
  const std::string json = SimulationJson(simulation, logs);
  io::WriteTextFile(folder / ResultFile::kMetrics, json);
  if (arguments.verbosity.json) {
    Print("{}", json);
  } else if (!arguments.verbosity.quiet) {
    Print("{}results        {}\n", SimulationSummary(simulation, logs), folder.path().string());
  }
  return is_complete ? ExitCode::kDone : ExitCode::kInterrupted;
}

void AddNetworkSettings(CLI::App& parser, SimArguments& arguments) {
  CLI::Option* dds =
      parser.add_flag("--dds", arguments.dds, "publish scans, odometry and truth; take cmd_vel");
  dds->group("Network");
  parser
      .add_flag("--wait-for-answers",
                arguments.wait_for_answers,
                "simulate as fast as the service answers")
      ->needs(dds)
      ->group("Network");
  parser.add_option("--network", arguments.network, "domain, interface or tag; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group("Network");
  CLI::Option* view = AddViewFlag(parser, arguments.view);
  view->group("Network");
  parser
      .add_option("--page", arguments.page, "port, address or token of the page; may be repeated")
      ->needs(view)
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group("Network");
}

}  // namespace

Command AddSimCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "sim", "logs of simulated robots, with the truth");
  auto arguments = std::make_shared<SimArguments>();
  parser->footer(
      "  qwsm sim park                                a shipped scenario, into results/latest\n"
      "  qwsm sim park --seed 7 --output park-7       other trees\n"
      "  qwsm sim my.yaml --duration 60               one's own, for a minute\n"
      "  qwsm sim office --set layout.office.persons=0\n"
      "  qwsm sim team --dds                          live on the network, in real time\n"
      "  qwsm sim team --view                         and seen at http://localhost:8765/\n"
      "  qwsm sim park --dds --wait-for-answers       as fast as 'qwsm serve' can map it");
  parser
      ->add_option(
          "SCENARIO",
          arguments->scenario.scenario,
          "a YAML file, or park, corridor, office, rubble, campus, joystick, team or one of "
          "its variants: team_unknown, team_wrong, team_late, team_carried, team_wings, "
          "team_corridor, team_campus")
      ->required()
      ->type_name("");
  parser
      ->add_option("-o,--output", arguments->output, "folder for the results; else results/<time>")
      ->type_name("DIR");
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  AddScenarioSettings(*parser, arguments->scenario);
  parser
      ->add_option(
          "--set", arguments->scenario.settings, "one option of the scenario; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group("Simulation");
  parser
      ->add_option("--speed",
                   arguments->real_time_factor,
                   "simulated seconds in a real one; else as fast as it can")
      ->check(NumberBetween(1e-3, 1e6))
      ->type_name("FACTOR")
      ->group("Simulation");
  AddNetworkSettings(*parser, *arguments);
  AddVerbosity(*parser, arguments->verbosity, "the summary as JSON");
  return {.parser = parser, .run = [arguments] { return RunSim(*arguments); }};
}

}  // namespace qwsm::apps
