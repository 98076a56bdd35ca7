// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/serving.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "service/apps/output.hpp"
#include "service/apps/page.hpp"
#include "service/io/files/atomic_file.hpp"

namespace qwsm::apps {

Command AddServeCommand(CLI::App& program, const ServeCommand& serve) {
  CLI::App* parser = AddParser(program, "serve", serve.help);
  auto arguments = std::make_shared<ServeArguments>();
  parser->footer(serve.examples);
  parser->add_option("ROBOT", arguments->robots, "namespaces of robots; else all that appear")
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "folder for the results; else none")
      ->type_name("DIR");
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  parser->add_option("--journal", arguments->journal, "where the map's scans are kept for restarts")
      ->type_name("FILE");
  AddViewFlag(*parser, arguments->view);
  AddNetworkArguments(*parser, arguments->network, "messages as JSON, one object a line");
  return {.parser = parser, .run = [arguments, run = serve.run] { return run(*arguments); }};
}

std::optional<pipeline::ResultsFolder> BeginResults(const ServeArguments& arguments,
                                                    const std::string& configuration) {
  if (arguments.network.verbosity.json) WriteMessagesAsJson();
  if (!arguments.output) return std::nullopt;
  const std::array inputs{arguments.journal};
  pipeline::ResultsFolder folder(*arguments.output, arguments.force, inputs);
  CopyMessagesTo(folder / pipeline::ResultFile::kLog);
  io::WriteTextFile(folder / pipeline::ResultFile::kConfig, configuration);
  return folder;
}

std::unique_ptr<view::LiveView> ShowLive(const ServeArguments& arguments,
                                         const view::ViewOptions& options,
                                         const Shown& shown) {
  if (!arguments.view) return nullptr;
  view::LiveView::Service service{.name = shown.identity,
                                  .marks = shown.marks,
                                  .warn = [](const std::string& text) { messages::Warn(text); }};
  auto view =
      std::make_unique<view::LiveView>(shown.participant, shown.graph, options, std::move(service));
  TellPage(view->url(), !arguments.network.verbosity.quiet);
  return view;
}

team::MarkJournal JournalForMarks(const ServeArguments& arguments) {
  return {arguments.journal, [](const std::string& text) { messages::Warn(text); }};
}

void Summarize(const team::TeamStatus& status) {
  const auto milliseconds = [](std::chrono::nanoseconds duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  };
  for (const team::RobotStatus& robot : status.robots) {
    Print(
        "{:<14} {} of {} scans answered, {} dead-reckoned, {} without odometry, {} dropped, "
        "{} unplaced, {} relevant{}; "
        "latency {:.2f} ms, p99 {:.2f} ms\n",
        team::DisplayName(robot.name),
        robot.counts.answered,
        robot.counts.scans,
        robot.counts.dead_reckoned,
        robot.counts.without_odometry,
        robot.counts.dropped,
        robot.counts.unplaced,
        robot.counts.relevant,
        robot.counts.contradicted_poses == 0
            ? std::string()
            : fmt::format(", {} initial poses contradicted", robot.counts.contradicted_poses),
        milliseconds(robot.latency.median),
        milliseconds(robot.latency.p99));
  }
  const std::size_t corrections = status.map.corrections;
  Print("map            {} points of {} relevant scans{}\n",
        status.map.points,
        status.map.scans,
        corrections == 0   ? std::string()
        : corrections == 1 ? std::string(", corrected once")
                           : fmt::format(", corrected {} times", corrections));
}

}  // namespace qwsm::apps
