// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/network.hpp"
#include "service/apps/service_manager.hpp"
#include "service/apps/version.hpp"
#include "service/dds/team_inbox.hpp"
#include "service/dds/team_outbox.hpp"
#include "service/io/atomic_file.hpp"
#include "service/pipeline/interruption.hpp"
#include "service/pipeline/results_folder.hpp"
#include "service/pipeline/team_log.hpp"
#include "service/pipeline/team_results.hpp"
#include "service/pipeline/team_sinks.hpp"
#include "service/team/team_service.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;

struct ServeArguments {
  std::vector<std::string> robots;
  std::optional<std::filesystem::path> output;
  std::filesystem::path journal;
  bool force = false;
  NetworkArguments network;
};

/// The service and everything that listens to it.
class Server {
 public:
  Server(const ServeArguments& arguments,
         const config::ProgramOptions& options,
         const std::optional<pipeline::ResultsFolder>& folder)
      : refusals_([](const std::string& text) { spdlog::warn("{}", text); }),
        participant_(options.network),
        outbox_(participant_, options.network, refusals_),
        results_(folder ? std::make_unique<pipeline::TeamResults>(*folder, options.rendering)
                        : nullptr),
        sinks_(Sinks()),
        service_({.team = options.team, .mapper = options.mapper, .rendering = options.rendering},
                 sinks_,
                 arguments.journal),
        inbox_(participant_, arguments.robots, service_, outbox_, refusals_) {}

  void Run(const pipeline::Interruption& interruption) {
    ServiceManager manager;
    service_.Start();
    manager.TellReady("serving");
    spdlog::info("serving as {}", service_.identity());
    while (!interruption.requested()) {
      inbox_.Deliver(20ms);  // A signal does not end this.
      manager.TellAlive("serving");
    }
    manager.TellStopping();
    service_.Stop();
    if (results_) results_->Finish(service_);
  }

  team::TeamStatus Status() const { return service_.Status(); }

 private:
  // Files before topics: who hears of an answer finds it on disk.
  std::vector<team::TeamSink*> Sinks() {
    std::vector<team::TeamSink*> sinks{&log_, &outbox_};
    if (results_) sinks.insert(sinks.begin(), results_.get());
    return sinks;
  }

  dds::Refusals refusals_;
  dds::Participant participant_;
  pipeline::TeamLog log_;
  dds::TeamOutbox outbox_;
  std::unique_ptr<pipeline::TeamResults> results_;
  pipeline::TeamSinks sinks_;
  team::TeamService service_;
  dds::TeamInbox inbox_;
};

void Summarize(const team::TeamStatus& status) {
  for (const team::RobotStatus& robot : status.robots) {
    const auto milliseconds = [](std::chrono::nanoseconds duration) {
      return std::chrono::duration<double, std::milli>(duration).count();
    };
    fmt::print(
        "{:<14} {} of {} scans answered, {} dropped, {} relevant; latency {:.2f} ms, p99 {:.2f} "
        "ms\n",
        team::DisplayName(robot.name),
        robot.counts.answered,
        robot.counts.scans,
        robot.counts.dropped,
        robot.counts.relevant,
        milliseconds(robot.latency.median),
        milliseconds(robot.latency.p99));
  }
  fmt::print(
      "map            {} points of {} relevant scans\n", status.map.points, status.map.scans);
}

ExitCode RunServe(const ServeArguments& arguments) {
  const NetworkSession session(arguments.network);
  if (arguments.network.verbosity.json) WriteMessagesAsJson();
  std::optional<pipeline::ResultsFolder> folder;
  if (arguments.output) {
    folder.emplace(*arguments.output, arguments.force);
    CopyMessagesTo(*folder / "run.log");
    io::WriteTextFile(*folder / "config.yaml", config::DumpOptions(session.options()));
  }
  spdlog::info("version {}", Version());
  const pipeline::Interruption interruption;
  Server server(arguments, session.options(), folder);
  server.Run(interruption);
  if (!arguments.network.verbosity.quiet) Summarize(server.Status());
  return ExitCode::kDone;
}

}  // namespace

Command AddServeCommand(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("serve", "poses and maps for robots on the network");
  auto arguments = std::make_shared<ServeArguments>();
  parser->footer(
      "  qwsm serve                        for whoever publishes scans, until Ctrl-C\n"
      "  qwsm serve --output run-7         and leave paths and map there\n"
      "  qwsm serve --journal team.db      and have the map back when started again\n"
      "  ROS_DOMAIN_ID=7 qwsm serve        in another DDS domain");
  parser->add_option("ROBOT", arguments->robots, "namespaces of robots; else all that appear")
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "folder for the results; else none")
      ->type_name("DIR");
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  parser->add_option("--journal", arguments->journal, "where relevant scans are kept for restarts")
      ->type_name("FILE");
  AddNetworkArguments(*parser, arguments->network, "messages as JSON, one object a line");
  return {.parser = parser, .run = [arguments] { return RunServe(*arguments); }};
}

}  // namespace qwsm::apps
