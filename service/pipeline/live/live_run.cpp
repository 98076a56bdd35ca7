// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/live/live_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/robot/robot_publisher.hpp"
#include "service/dds/service/mark_exchange.hpp"
#include "service/dds/service/service_outbox.hpp"
#include "service/dds/service/team_map_outbox.hpp"
#include "service/dds/wire/diagnostics.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/pipeline/text/messages.hpp"
#include "service/view/live_view.hpp"

namespace qwsm::pipeline {
namespace {

// A log goes by faster than anybody sees.
constexpr std::chrono::milliseconds kScanPeriod{40};
constexpr std::chrono::milliseconds kAnswerPeriod{4};
constexpr std::chrono::seconds kMapPeriod{1};

const std::string kOnlyRobot;  // It has no namespace.

dds::NetworkOptions OwnNetwork(dds::NetworkOptions options) {
  options.interface = "lo";
  options.tag = fmt::format("qwsm-map-{}", getpid());
  return options;
}

void Warn(const std::string& text) { messages::Warn(text); }

}  // namespace

/// What the page sees of the run.
class LiveRun::Topics {
 public:
  Topics(const options::ProgramOptions& options, const std::string& name)
      : network_(OwnNetwork(options.network)),
        participant_(network_),
        graph_(participant_, network_),
        robot_(participant_, dds::RobotNames(kOnlyRobot), dds::OdometryUse::kNone),
        answers_(participant_, graph_, refusals_),
        maps_(participant_, graph_),
        health_(participant_, dds::kDiagnosticsTopic, dds::Profile::kAnswer),
        marks_(participant_, refusals_, team::MarkJournal({}, Warn)),
        view_(participant_, graph_, options.view, {.name = name, .marks = marks_, .warn = Warn}) {
    answers_.AddRobot(kOnlyRobot, {});
    marks_.Start();
  }

  std::string url() const { return view_.url(); }
  std::vector<team::Mark> marks() const { return marks_.marks(); }

  void Show(const team::RobotAnswer& answer) {
    answers_.TakeAnswer(answer);
    answers_.TakeReport(answer);
  }
  void Show(const Observation& observation) { robot_.Publish(observation); }
  void Show(const team::TeamScan& scan) { maps_.TakeRelevantScan(scan); }
  void Show(const team::MapPicture& map) { maps_.TakeMap(map); }
  void Show(const team::TeamEpoch& epoch) {
    maps_.TakeEpoch(epoch);
    marks_.Follow(epoch);
  }
  void Show(const std::vector<dds::Health>& health) const {
    health_.Write(
        dds::HealthSample(health, std::chrono::system_clock::now().time_since_epoch()).sample());
  }

 private:
  dds::NetworkOptions network_;
  dds::Refusals refusals_{Warn};
  dds::Participant participant_;
  dds::RosGraph graph_;
  dds::RobotPublisher robot_;
  dds::ServiceOutbox<team::TeamSink> answers_;
  dds::TeamMapOutbox maps_;
  dds::Writer<dds::wire::DiagnosticArray> health_;
  dds::MarkExchange marks_;
  view::LiveView view_;
};

LiveRun::LiveRun(const options::ProgramOptions& options, const std::string& name)
    : name_(name),
      rendering_(options.rendering),
      topics_(std::make_unique<Topics>(options, name)),
      painter_(options.rendering) {}

LiveRun::~LiveRun() = default;

std::string LiveRun::url() const { return topics_->url(); }

std::vector<team::Mark> LiveRun::marks() const { return topics_->marks(); }

void LiveRun::Take(const TimedStep& timed) {
  ++scans_;
  newest_ = timed.step.stamp;
  const auto now = Clock::now();
  ShowAnswer(timed, now);
  if (timed.scan != nullptr && now - scan_shown_ >= kScanPeriod) {
    scan_shown_ = now;
    topics_->Show(Observation{.scan = *timed.scan, .T_odom_robot = timed.T_odom_robot});
  }
  if (timed.step.relevant) ShowRelevant(timed);
  if (now - map_shown_ < kMapPeriod) return;
  map_shown_ = now;
  ShowHealth();
  if (!has_new_cells_) return;
  has_new_cells_ = false;
  ShowMap();
}

void LiveRun::ShowAnswer(const TimedStep& timed, Clock::time_point now) {
  const bool is_as_before = std::exchange(status_, timed.step.status) == timed.step.status;
  if (is_as_before && now - answer_shown_ < kAnswerPeriod) return;
  answer_shown_ = now;
  topics_->Show(team::RobotAnswer{.robot = kOnlyRobot,
                                  .step = timed.step,
                                  .T_odom_robot = timed.T_odom_robot,
                                  .matching = timed.duration,
                                  .latency = timed.duration,
                                  .scans = scans_});
}

void LiveRun::ShowRelevant(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  topics_->Show(team::TeamScan{.key = KeyOf(relevant_.size()),
                               .scan = step.relevant_scan,
                               .map_robot = step.map_robot,
                               .T_odom_robot = timed.T_odom_robot});
  painter_.Add({.scan = step.relevant_scan, .map_robot = step.map_robot});
  relevant_.push_back(step.map_robot.T_a_b);
  has_new_cells_ = true;
}

team::ScanKey LiveRun::KeyOf(std::uint64_t relevant) const {
  return {.service = name_, .robot = kOnlyRobot, .sequence = relevant};
}

void LiveRun::Correct(const MapEpoch& epoch, std::span<const RelevantScan> scans) {
  team::TeamEpoch told{
      .rank = {.number = ++epochs_, .service = name_}, .stamp = epoch.stamp, .scans = {}};
  for (std::size_t i = 0; i < std::min(relevant_.size(), epoch.map_node.size()); ++i) {
    told.scans.push_back(
        {.key = KeyOf(i), .T_map_robot_before = relevant_[i], .map_robot = epoch.map_node[i]});
    relevant_[i] = epoch.map_node[i].T_a_b;
  }
  topics_->Show(told);
  painter_ = OccupancyPainter(rendering_);
  for (const RelevantScan& scan : scans) painter_.Add(scan);
  has_new_cells_ = true;
}

void LiveRun::ShowMap() const {
  const OccupancyGridResult drawn = painter_.Grid();
  if (drawn.status != RenderStatus::kRendered) return;
  topics_->Show(team::MapPicture{
      .component = {}, .frame = dds::kMapFrame, .stamp = newest_, .grid = drawn.grid});
}

void LiveRun::ShowHealth() const {
  topics_->Show(std::vector<dds::Health>{
      {.name = "qwsm: service",
       .message = name_,
       .values = {{"robots", "1"}, {"scans", fmt::format("{}", scans_)}}},
      {.name = "qwsm: " + team::DisplayName(kOnlyRobot), .message = state_}});
}

void LiveRun::Finish(std::span<const RelevantScan> scans, const std::string& end) {
  state_ = end;
  painter_ = OccupancyPainter(rendering_);
  for (const RelevantScan& scan : scans) painter_.Add(scan);
  ShowMap();
  ShowHealth();
}

void LiveRun::StayUntil(const Interruption& interruption) {
  while (!interruption.requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (Clock::now() - map_shown_ < kMapPeriod) continue;
    map_shown_ = Clock::now();
    ShowHealth();
  }
}

}  // namespace qwsm::pipeline
