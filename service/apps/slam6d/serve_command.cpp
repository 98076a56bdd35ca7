// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/serving.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/dds/service/cloud_inbox.hpp"
#include "service/dds/service/cloud_map_outbox.hpp"
#include "service/dds/service/cloud_mark_places.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/service/service_outbox.hpp"
#include "service/options/slam6d/program_options.hpp"
#include "service/pipeline/slam6d/cloud_results.hpp"
#include "service/pipeline/team/team_log.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/team/service/cloud_service.hpp"

namespace slam6d::apps {
namespace {

using qwsm::apps::ServeArguments;
using qwsm::pipeline::ResultsFolder;
using qwsm::team::CloudSink;

/// The service and everything that listens to it.
class CloudServer {
 public:
  CloudServer(const ServeArguments& arguments,
              const options::ProgramOptions& options,
              const std::optional<ResultsFolder>& folder)
      : participant_(options.network),
        graph_(participant_, options.network),
        outbox_(participant_, graph_, refusals_),
        map_outbox_(participant_, graph_),
        marks_(participant_, refusals_, qwsm::apps::JournalForMarks(arguments)),
        mark_places_(marks_),
        results_(folder ? std::make_unique<pipeline::CloudResults>(*folder, options) : nullptr),
        closer_(graph::MakeLoopCloser(options.loop_error)),
        service_(
            {.team = options.team, .slam = options.slam}, *closer_, Sinks(), arguments.journal),
        inbox_(participant_,
               arguments.robots,
               {std::string(qwsm::dds::kCloudTopic)},
               service_.robots(),
               {&map_outbox_, &outbox_},
               refusals_),
        view_(qwsm::apps::ShowLive(
            arguments, options.view, {participant_, graph_, service_.identity(), marks_})) {
    marks_.Start();
  }

  void Run(const qwsm::pipeline::Interruption& interruption) {
    qwsm::apps::Serve(qwsm::apps::Serving{service_, inbox_, results_.get()}, interruption);
  }
  qwsm::team::TeamStatus Status() const { return service_.Status(); }

 private:
  // Files before topics: who hears of an answer finds it kept.
  std::vector<CloudSink*> Sinks() {
    std::vector<CloudSink*> sinks{&log_, &outbox_, &map_outbox_, &mark_places_};
    if (results_) sinks.insert(sinks.begin(), results_.get());
    return sinks;
  }

  qwsm::dds::Refusals refusals_{[](const std::string& text) { qwsm::messages::Warn(text); }};
  qwsm::dds::Participant participant_;
  qwsm::dds::RosGraph graph_;
  qwsm::pipeline::TeamLog<CloudSink> log_;
  qwsm::dds::ServiceOutbox<CloudSink> outbox_;
  qwsm::dds::CloudMapOutbox map_outbox_;
  qwsm::dds::MarkExchange marks_;
  qwsm::dds::CloudMarkPlaces mark_places_;
  std::unique_ptr<pipeline::CloudResults> results_;
  std::unique_ptr<LoopCloser> closer_;
  qwsm::team::CloudService service_;
  qwsm::dds::CloudInbox inbox_;
  std::unique_ptr<qwsm::view::LiveView> view_;  // Null where nobody wants to look.
};

}  // namespace

Command AddServeCommand(CLI::App& program) {
  return qwsm::apps::AddServeCommand(
      program,
      {.help = "poses and models for robots on the network",
       .examples =
           "  slam6d serve                      for whoever publishes clouds, until Ctrl-C\n"
           "  slam6d serve --output run-7       and leave poses, models and pictures there\n"
           "  slam6d serve --journal team.db    and have the models back when started again\n"
           "  slam6d serve --view               and be seen at http://localhost:8765/\n"
           "  ROS_DOMAIN_ID=7 slam6d serve      in another DDS domain",
       .run = qwsm::apps::RunServe<CloudServer, options::ProgramOptions>});
}

}  // namespace slam6d::apps
