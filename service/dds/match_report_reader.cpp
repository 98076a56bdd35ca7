// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/match_report_reader.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "service/dds/reader.hpp"
#include "service/dds/report_conversion.hpp"
#include "service/dds/robot_discovery.hpp"
#include "service/dds/robot_names.hpp"
#include "service/dds/wait_set.hpp"

namespace qwsm::dds {

class MatchReportReader::Topics {
 public:
  Topics(const Participant& participant, const std::vector<std::string>& robots)
      : participant_(participant), wait_set_(participant) {
    for (const std::string& robot : robots) Listen(robot);
    if (!robots.empty()) return;
    discovery_.emplace(participant, std::string(kReportTopic), kMatchReportType);
    wait_set_.Add(discovery_->handle());
  }

  bool has_writer() const {
    return std::ranges::any_of(readers_,
                               [](const auto& named) { return named.second.writer_count() > 0; });
  }

  std::vector<MatchReport> Take(std::chrono::nanoseconds timeout) {
    std::vector<MatchReport> reports;
    wait_set_.Wait(timeout);
    if (discovery_) {
      for (const std::string& robot : discovery_->Take().joined) Listen(robot);
    }
    for (const auto& [robot, reader] : readers_) {
      reader.TakeAll([&reports](const wire::MatchReport& sample) {
        if (auto report = FromWire(sample)) reports.push_back(std::move(*report));
      });
    }
    return reports;
  }

 private:
  void Listen(const std::string& robot) {
    if (readers_.contains(robot)) return;
    const auto added = readers_.try_emplace(
        robot, participant_, RobotNames(robot).Topic(kReportTopic), Profile::kAnswerIn);
    wait_set_.Add(added.first->second.handle());
  }

  const Participant& participant_;
  WaitSet wait_set_;
  std::optional<RobotDiscovery> discovery_;
  std::map<std::string, Reader<wire::MatchReport>> readers_;
};

MatchReportReader::MatchReportReader(const Participant& participant,
                                     const std::vector<std::string>& robots)
    : topics_(std::make_unique<Topics>(participant, robots)) {}

MatchReportReader::~MatchReportReader() = default;

bool MatchReportReader::has_writer() const { return topics_->has_writer(); }

std::vector<MatchReport> MatchReportReader::Take(std::chrono::nanoseconds timeout) {
  return topics_->Take(timeout);
}

}  // namespace qwsm::dds
