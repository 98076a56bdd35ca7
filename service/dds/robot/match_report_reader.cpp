// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/match_report_reader.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "service/dds/entities/reader.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/dds/robot/robot_discovery.hpp"
#include "service/dds/wire/report_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/wire_kind.hpp"

namespace qwsm::dds {

template <class Kind>
class BasicReportReader<Kind>::Topics {
 public:
  using WireReport = typename OnWire<Kind>::WireReport;

  Topics(const Participant& participant, const std::vector<std::string>& robots)
      : participant_(participant), wait_set_(participant) {
    for (const std::string& robot : robots) Listen(robot);
    if (!robots.empty()) return;
    discovery_.emplace(participant,
                       std::vector{std::string(OnWire<Kind>::kReportTopic)},
                       OnWire<Kind>::kReportType);
    wait_set_.Add(discovery_->handle());
  }

  bool has_writer() const {
    return std::ranges::any_of(readers_,
                               [](const auto& named) { return named.second.writer_count() > 0; });
  }

  std::vector<Report> Take(std::chrono::nanoseconds timeout) {
    std::vector<Report> reports;
    wait_set_.Wait(timeout);
    if (discovery_) {
      for (const std::string& robot : discovery_->Take().joined) Listen(robot);
    }
    for (const auto& [robot, reader] : readers_) {
      reader.TakeAll([&reports](const WireReport& sample) {
        if (auto report = FromWire(sample)) reports.push_back(std::move(*report));
      });
    }
    return reports;
  }

 private:
  void Listen(const std::string& robot) {
    if (readers_.contains(robot)) return;
    const auto added = readers_.try_emplace(robot,
                                            participant_,
                                            RobotNames(robot).Topic(OnWire<Kind>::kReportTopic),
                                            Profile::kAnswerIn);
    wait_set_.Add(added.first->second.handle());
  }

  const Participant& participant_;
  WaitSet wait_set_;
  std::optional<RobotDiscovery> discovery_;
  std::map<std::string, Reader<WireReport>> readers_;
};

template <class Kind>
BasicReportReader<Kind>::BasicReportReader(const Participant& participant,
                                           const std::vector<std::string>& robots)
    : topics_(std::make_unique<Topics>(participant, robots)) {}

template <class Kind>
BasicReportReader<Kind>::~BasicReportReader() = default;

template <class Kind>
bool BasicReportReader<Kind>::has_writer() const {
  return topics_->has_writer();
}

template <class Kind>
std::vector<typename BasicReportReader<Kind>::Report> BasicReportReader<Kind>::Take(
    std::chrono::nanoseconds timeout) {
  return topics_->Take(timeout);
}

template class BasicReportReader<team::Planar>;
template class BasicReportReader<team::Spatial>;

}  // namespace qwsm::dds
