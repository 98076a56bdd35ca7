// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/serving.hpp"
#include "service/apps/version.hpp"
#include "service/dds/service/team_inbox.hpp"
#include "service/dds/service/team_outbox.hpp"
#include "service/pipeline/team/team_log.hpp"
#include "service/pipeline/team/team_results.hpp"
#include "service/pipeline/team/team_sinks.hpp"
#include "service/team/service/team_service.hpp"

namespace qwsm::apps {
namespace {

/// The service and everything that listens to it.
class Server {
 public:
  Server(const ServeArguments& arguments,
         const options::ProgramOptions& options,
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
    Serve(Serving{service_, inbox_, results_.get()}, interruption);
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

ExitCode RunServe(const ServeArguments& arguments) {
  const NetworkSession session(arguments.network);
  const std::optional<pipeline::ResultsFolder> folder =
      BeginResults(arguments, config::DumpOptions(session.options()));
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
  AddServeArguments(*parser, *arguments);
  return {.parser = parser, .run = [arguments] { return RunServe(*arguments); }};
}

}  // namespace qwsm::apps
