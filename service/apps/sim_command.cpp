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
#include "service/apps/scenario_arguments.hpp"
#include "service/apps/version.hpp"
#include "service/config/options_io.hpp"
#include "service/dds/entities/middleware_messages.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/network/network_robot.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/simulation/simulation_report.hpp"
#include "service/pipeline/simulation/simulation_run.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;
using namespace pipeline;

struct SimArguments {
  ScenarioArguments scenario;
  std::optional<fs::path> output;
  std::optional<double> real_time_factor;
  std::vector<std::string> network;  ///< `key=value` of dds::NetworkOptions.
  bool dds = false;
  bool wait_for_answers = false;
  Verbosity verbosity;
  bool force = false;
};

SimulatedLogs OpenLogs(const sim::Simulation& simulation, const ResultsFolder& folder) {
  SimulatedLogs logs;
  for (std::size_t i = 0; i < simulation.robots().size(); ++i) {
    const std::string& name = simulation.robots()[i].options().name;
    logs.push_back(std::make_unique<SimulatedLog>(folder.path(), i, name));
  }
  return logs;
}

/// All robots of a simulation on the network.
class NetworkTeam {
 public:
  NetworkTeam(const SimArguments& arguments, sim::Simulation& simulation)
      : messages_([](const std::string& text) { messages::Warn(text); }),
        participant_(config::LoadOptions<dds::NetworkOptions>(
            {.file = std::nullopt, .settings = arguments.network})) {
    const auto pace = arguments.wait_for_answers ? NetworkPace::kAnswers : NetworkPace::kFree;
    for (std::size_t i = 0; i < simulation.robots().size(); ++i) {
      robots_.push_back(std::make_unique<NetworkRobot>(participant_, simulation, i, pace));
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

  dds::MiddlewareMessages messages_;
  dds::Participant participant_;
  std::vector<std::unique_ptr<NetworkRobot>> robots_;
};

ExitCode RunSim(const SimArguments& arguments) {
  StartMessages(arguments.verbosity);
  const sim::ScenarioOptions scenario = LoadScenario(arguments.scenario);
  sim::Simulation simulation(scenario);
  const ResultsFolder folder = arguments.output ? ResultsFolder(*arguments.output, arguments.force)
                                                : ResultsFolder::ForNow("results");
  CopyMessagesTo(folder / "run.log");
  messages::Info("version {}", Version());
  io::WriteTextFile(folder / "scenario.yaml", ScenarioText(scenario));

  const SimulatedLogs logs = OpenLogs(simulation, folder);
  SimulationProgress progress(simulation,
                              arguments.verbosity.quiet ? ProgressStyle::kNone : StyleFor(stderr));
  Pacer pacer(arguments.real_time_factor.value_or(1.0));
  std::vector<ReadingSink*> sinks{&progress};
  for (const auto& log : logs) sinks.push_back(log.get());
  const bool is_live = arguments.dds && !arguments.wait_for_answers;
  if (arguments.real_time_factor || is_live) sinks.push_back(&pacer);
  std::optional<NetworkTeam> team;
  if (arguments.dds) team.emplace(arguments, simulation).AddTo(sinks);
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
  io::WriteTextFile(folder / "metrics.json", json);
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
      ->needs(dds)
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
      "  qwsm sim park --dds --wait-for-answers       as fast as 'qwsm serve' can map it");
  parser
      ->add_option("SCENARIO",
                   arguments->scenario.scenario,
                   "a YAML file, or park, corridor, office, rubble, campus, team or joystick")
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
