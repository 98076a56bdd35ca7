// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/serving.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/apps/slam6d/network.hpp"
#include "service/apps/version.hpp"
#include "service/dds/service/cloud_inbox.hpp"
#include "service/dds/service/cloud_outbox.hpp"
#include "service/pipeline/slam6d/cloud_results.hpp"
#include "service/pipeline/slam6d/cloud_sinks.hpp"

namespace slam6d::apps {
namespace {

using qwsm::apps::ServeArguments;
using qwsm::pipeline::ResultsFolder;

/// The service and everything that listens to it.
class Server {
 public:
  Server(const ServeArguments& arguments,
         const options::ProgramOptions& options,
         const std::optional<ResultsFolder>& folder)
      : refusals_([](const std::string& text) { spdlog::warn("{}", text); }),
        participant_(options.network),
        outbox_(participant_, options.network, refusals_),
        results_(folder ? std::make_unique<pipeline::CloudResults>(*folder, options) : nullptr),
        sinks_(Sinks()),
        closer_(graph::MakeLoopCloser(options.loop_error)),
        service_({.team = options.team, .slam = options.slam}, *closer_, sinks_, arguments.journal),
        inbox_(participant_, arguments.robots, service_, outbox_, refusals_) {}

  void Run(const qwsm::pipeline::Interruption& interruption) {
    qwsm::apps::Serve(qwsm::apps::Serving{service_, inbox_, results_.get()}, interruption);
  }
  qwsm::team::TeamStatus Status() const { return service_.Status(); }

 private:
  // Files before topics: who hears of an answer finds it kept.
  std::vector<qwsm::team::CloudSink*> Sinks() {
    std::vector<qwsm::team::CloudSink*> sinks{&log_, &outbox_};
    if (results_) sinks.insert(sinks.begin(), results_.get());
    return sinks;
  }

  qwsm::dds::Refusals refusals_;
  qwsm::dds::Participant participant_;
  pipeline::CloudLog log_;
  qwsm::dds::CloudOutbox outbox_;
  std::unique_ptr<pipeline::CloudResults> results_;
  pipeline::CloudSinks sinks_;
  std::unique_ptr<LoopCloser> closer_;
  qwsm::team::CloudService service_;
  qwsm::dds::CloudInbox inbox_;
};

ExitCode RunServe(const ServeArguments& arguments) {
  const NetworkSession session(arguments.network);
  const std::optional<ResultsFolder> folder =
      qwsm::apps::BeginResults(arguments, qwsm::config::DumpOptions(session.options()));
  spdlog::info("version {}", qwsm::apps::Version());
  const qwsm::pipeline::Interruption interruption;
  Server server(arguments, session.options(), folder);
  server.Run(interruption);
  if (!arguments.network.verbosity.quiet) qwsm::apps::Summarize(server.Status());
  return ExitCode::kDone;
}

}  // namespace

Command AddServeCommand(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("serve", "poses and models for robots on the network");
  auto arguments = std::make_shared<ServeArguments>();
  parser->footer(
      "  slam6d serve                      for whoever publishes clouds, until Ctrl-C\n"
      "  slam6d serve --output run-7       and leave poses, models and pictures there\n"
      "  slam6d serve --journal team.db    and have the models back when started again\n"
      "  ROS_DOMAIN_ID=7 slam6d serve      in another DDS domain");
  qwsm::apps::AddServeArguments(*parser, *arguments);
  return {.parser = parser, .run = [arguments] { return RunServe(*arguments); }};
}

}  // namespace slam6d::apps
