// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "service/team/sinks/team_sink.hpp"

namespace qwsm::pipeline {

/// Hands everything to several sinks, in their order.
class TeamSinks final : public team::TeamSink {
 public:
  /// @param sinks outlive this.
  explicit TeamSinks(std::vector<team::TeamSink*> sinks) : sinks_(std::move(sinks)) {}

  void TakeAnswer(const team::RobotAnswer& answer) override {
    for (team::TeamSink* sink : sinks_) sink->TakeAnswer(answer);
  }
  void TakeReport(const team::RobotAnswer& report) override {
    for (team::TeamSink* sink : sinks_) sink->TakeReport(report);
  }
  void TakeRelevantScan(const team::TeamScan& scan) override {
    for (team::TeamSink* sink : sinks_) sink->TakeRelevantScan(scan);
  }
  void TakeNewPoints(const team::NewPoints& points) override {
    for (team::TeamSink* sink : sinks_) sink->TakeNewPoints(points);
  }
  void TakeMap(const team::MapPicture& map) override {
    for (team::TeamSink* sink : sinks_) sink->TakeMap(map);
  }
  void TakeStatus(const team::TeamStatus& status) override {
    for (team::TeamSink* sink : sinks_) sink->TakeStatus(status);
  }
  void TakeEvent(const team::TeamEvent& event) override {
    for (team::TeamSink* sink : sinks_) sink->TakeEvent(event);
  }

 private:
  std::vector<team::TeamSink*> sinks_;
};

}  // namespace qwsm::pipeline
