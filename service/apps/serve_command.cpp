// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/serving.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/service/service_outbox.hpp"
#include "service/dds/service/team_inbox.hpp"
#include "service/dds/service/team_map_outbox.hpp"
#include "service/dds/service/team_mark_places.hpp"
#include "service/options/program_options.hpp"
#include "service/pipeline/results/marks_list.hpp"
#include "service/pipeline/team/team_log.hpp"
#include "service/pipeline/team/team_results.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/service/team_service.hpp"
#include "service/view/live_view.hpp"

namespace qwsm::apps {
namespace {

/// The service and everything that listens to it.
class TeamServer {
 public:
  TeamServer(const ServeArguments& arguments,
             const options::ProgramOptions& options,
             const std::optional<pipeline::ResultsFolder>& folder)
      : folder_(folder),
        participant_(options.network),
        graph_(participant_, options.network),
        outbox_(participant_, graph_, refusals_),
        map_outbox_(participant_, graph_),
        marks_(participant_, refusals_, JournalForMarks(arguments)),
        mark_places_(marks_),
        results_(folder ? std::make_unique<pipeline::TeamResults>(
                              *folder,
                              pipeline::TeamResultsOptions{.rendering = options.rendering,
                                                           .corrects = options.graph.enabled})
                        : nullptr),
        service_({.team = options.team,
                  .mapper = options.mapper,
                  .corrects = options.graph.enabled,
                  .rendering = options.rendering},
                 Sinks(),
                 arguments.journal),
        inbox_(participant_, arguments.robots, service_, {&outbox_}, refusals_),
        view_(ShowLive(
            arguments, options.view, {participant_, graph_, service_.identity(), marks_})) {
    marks_.Start();
  }

  void Run(const pipeline::Interruption& interruption) {
    Serve(Serving{service_, inbox_, results_.get()}, interruption);
    if (folder_) pipeline::WriteMarks(folder_->path(), results_->Placed(marks_.marks()));
  }
  team::TeamStatus Status() const { return service_.Status(); }

 private:
  // Files before topics: who hears of an answer finds it on disk.
  std::vector<team::TeamSink*> Sinks() {
    std::vector<team::TeamSink*> sinks{&log_, &outbox_, &map_outbox_, &mark_places_};
    if (results_) sinks.insert(sinks.begin(), results_.get());
    return sinks;
  }

  std::optional<pipeline::ResultsFolder> folder_;
  dds::Refusals refusals_{[](const std::string& text) { messages::Warn(text); }};
  dds::Participant participant_;
  dds::RosGraph graph_;
  pipeline::TeamLog<team::TeamSink> log_;
  dds::ServiceOutbox<team::TeamSink> outbox_;
  dds::TeamMapOutbox map_outbox_;
  dds::MarkExchange marks_;
  dds::TeamMarkPlaces mark_places_;
  std::unique_ptr<pipeline::TeamResults> results_;
  team::TeamService service_;
  dds::TeamInbox inbox_;
  std::unique_ptr<view::LiveView> view_;  // Null where nobody wants to look.
};

}  // namespace

Command AddServeCommand(CLI::App& program) {
  return AddServeCommand(
      program,
      {.help = "poses and maps for robots on the network",
       .examples = "  qwsm serve                        for whoever publishes scans, until Ctrl-C\n"
                   "  qwsm serve --output run-7         and leave paths and map there\n"
                   "  qwsm serve --journal team.db      and have the map back when started again\n"
                   "  qwsm serve --view                 and be seen at http://localhost:8765/\n"
                   "  ROS_DOMAIN_ID=7 qwsm serve        in another DDS domain",
       .run = RunServe<TeamServer, options::ProgramOptions>});
}

}  // namespace qwsm::apps
