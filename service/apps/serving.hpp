// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network_session.hpp"
#include "service/apps/service_manager.hpp"
#include "service/apps/version.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/marks/mark_journal.hpp"
#include "service/team/sinks/team_status.hpp"
#include "service/view/live_view.hpp"

namespace qwsm::apps {

/// Arguments of `serve`, whatever the robots' sensors are.
struct ServeArguments {
  std::vector<std::string> robots;
  std::optional<std::filesystem::path> output;
  std::filesystem::path journal;
  bool force = false;
  bool view = false;
  NetworkArguments network;
};

/// Says what `serve` of a program tells of itself, and does.
struct ServeCommand {
  std::string help;
  std::string examples;
  std::function<ExitCode(const ServeArguments&)> run;
};

Command AddServeCommand(CLI::App& program, const ServeCommand& serve);

/// Begins messages as wanted, and the folder of the results, with messages and configuration in it;
/// nothing where no results are wanted.
/// @param configuration as YAML.
/// @throws io::WriteError.
std::optional<pipeline::ResultsFolder> BeginResults(const ServeArguments& arguments,
                                                    const std::string& configuration);

/// Where a service keeps the marks on its map: in its journal, if it has one.
team::MarkJournal JournalForMarks(const ServeArguments& arguments);

/// Tells on standard output what became of the robots' scans, a line for each robot.
void Summarize(const team::TeamStatus& status);

/// What a live page shows.
struct Shown {
  const dds::Participant& participant;
  const dds::RosGraph& graph;
  std::string identity;  ///< The service's.
  dds::MarkExchange& marks;
};

/// Serves the live page and tells where it is, if that is wanted; else null.
/// @param shown what it refers to outlives the page. @throws view::WebError.
std::unique_ptr<view::LiveView> ShowLive(const ServeArguments& arguments,
                                         const view::ViewOptions& options,
                                         const Shown& shown);

/// A service, the topics it listens to, and what is left of it in the end.
/// @tparam Service has identity(), Start() and Stop(). @tparam Inbox delivers to it.
/// @tparam Results finishes with it.
template <class Service, class Inbox, class Results>
struct Serving {
  Service& service;
  Inbox& inbox;
  Results* results;  ///< Null where no results are wanted.
};

/// Serves until the interruption, then stops and finishes the results.
template <class Service, class Inbox, class Results>
void Serve(const Serving<Service, Inbox, Results>& serving,
           const pipeline::Interruption& interruption) {
  ServiceManager manager;
  serving.service.Start();
  manager.TellReady("serving");
  messages::Info("serving as {}", serving.service.identity());
  while (!interruption.requested()) {
    serving.inbox.Deliver(std::chrono::milliseconds(20));  // A signal does not end this call.
    manager.TellAlive("serving");
  }
  manager.TellStopping();
  serving.service.Stop();
  if (serving.results != nullptr) serving.results->Finish(serving.service);
}

/// Does the whole of `serve`.
/// @tparam Server made of the arguments, a program's options and the folder of the results; it has
/// Run() and Status().
template <class Server, class Options>
ExitCode RunServe(const ServeArguments& arguments) {
  const BasicNetworkSession<Options> session(arguments.network);
  const std::optional<pipeline::ResultsFolder> folder =
      BeginResults(arguments, config::DumpOptions(session.options()));
  messages::Info("version {}", Version());
  const pipeline::Interruption interruption;
  Server server(arguments, session.options(), folder);
  server.Run(interruption);
  const team::TeamStatus status = server.Status();
  if (!arguments.network.verbosity.quiet) Summarize(status);
  return status.journal.waiting == 0 ? ExitCode::kDone : ExitCode::kIo;
}

}  // namespace qwsm::apps
