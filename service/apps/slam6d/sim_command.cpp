// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "service/apps/messages.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/apps/scenario_arguments.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/options/slam6d/program_options.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/slam6d/simulated_scans.hpp"

namespace slam6d::apps {
namespace {

namespace fs = std::filesystem;

struct SimArguments {
  qwsm::apps::ScenarioArguments scenario;
  fs::path output;
  std::optional<std::size_t> scans;
  std::optional<double> stop_every_m;
  qwsm::config::OptionSources sources;
  qwsm::apps::Verbosity verbosity;
  bool force = false;
};

void WriteScan(const pipeline::SimulatedScan& scan, std::size_t number, const fs::path& folder) {
  const std::string name = fmt::format("scan{:03}", number);
  io::WriteUosPoints(folder / (name + ".3d"), scan.cloud);
  io::WriteUosPose(folder / (name + ".pose"), scan.T_odom_scan);
  io::WriteUosFrames(folder / "gt" / (name + ".frames"), {}, scan.T_world_scan);
}

ExitCode RunSim(SimArguments arguments) {
  qwsm::apps::StartMessages(arguments.verbosity);
  arguments.scenario.settings = qwsm::apps::TakeScenarioSettings(arguments.sources.settings);
  const sim::ScenarioOptions scenario = qwsm::apps::LoadScenario(arguments.scenario);
  auto options = qwsm::config::LoadOptions<options::ProgramOptions>(arguments.sources);
  if (arguments.stop_every_m) options.sim.stop_every_m = *arguments.stop_every_m;
  const qwsm::pipeline::ResultsFolder folder(arguments.output, arguments.force);
  const qwsm::pipeline::ResultsFolder truth(folder / "gt", true);
  qwsm::io::WriteTextFile(folder / qwsm::pipeline::ResultFile::kScenario,
                          qwsm::apps::ScenarioText(scenario));
  const qwsm::pipeline::Interruption interruption;
  qwsm::pipeline::StatusLine line(arguments.verbosity.quiet ? qwsm::pipeline::ProgressStyle::kNone
                                                            : qwsm::pipeline::StyleFor(stderr));
  pipeline::SimulatedScans scans(scenario, options.sim);
  std::size_t count = 0;
  std::size_t points = 0;
  while (!interruption.requested() && !(arguments.scans && count >= *arguments.scans)) {
    const std::optional<pipeline::SimulatedScan> scan = scans.Next();
    if (!scan) break;
    WriteScan(*scan, count++, folder.path());
    points += scan->cloud.size();
    line.Show([&](auto) { return fmt::format("sim  {} scans", count); });
  }
  line.Clear();
  if (!arguments.verbosity.quiet) {
    qwsm::apps::Print("simulated      {} scans, {} points\nscans          {}\n",
                      count,
                      qwsm::pipeline::WithThousands(points),
                      folder.path().string());
  }
  return interruption.requested() ? ExitCode::kInterrupted : ExitCode::kDone;
}

}  // namespace

Command AddSimCommand(CLI::App& program) {
  CLI::App* parser =
      AddParser(program, "sim", "3D scans of a simulated drive, with odometry and truth");
  auto arguments = std::make_shared<SimArguments>();
  parser->footer(
      "  slam6d sim park --output park3d              scans as 3DTK has them, the truth in gt/\n"
      "  slam6d register park3d --output model        and registered\n"
      "  slam6d eval park3d model --truth park3d/gt   odometry and result against the truth\n"
      "  slam6d sim office --scans 10 --output o --set sim.laser.beams=361 --set "
      "sim.laser.sweeps=500");
  parser->add_option("SCENARIO", arguments->scenario.scenario, "a file, or a shipped one: park...")
      ->required()
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "folder for the scans")
      ->required()
      ->type_name("DIR");
  parser->add_option("--scans", arguments->scans, "stop after so many")->type_name("N");
  parser->add_option("--every", arguments->stop_every_m, "metres from one scan to the next")
      ->check(qwsm::apps::NumberBetween(0.05, 1e3))
      ->type_name("M");
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  qwsm::apps::AddScenarioSettings(*parser, arguments->scenario);
  qwsm::apps::AddConfiguration(*parser, arguments->sources);
  qwsm::apps::AddVerbosity(*parser, arguments->verbosity, {});
  return {.parser = parser, .run = [arguments] { return RunSim(*arguments); }};
}

}  // namespace slam6d::apps
