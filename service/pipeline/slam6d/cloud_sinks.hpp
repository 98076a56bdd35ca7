// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "service/pipeline/team/team_log.hpp"
#include "service/team/sinks/cloud_sink.hpp"

namespace slam6d::pipeline {

/// Hands everything to several sinks, in their order.
class CloudSinks final : public qwsm::team::CloudSink {
 public:
  /// @param sinks outlive this.
  explicit CloudSinks(std::vector<qwsm::team::CloudSink*> sinks) : sinks_(std::move(sinks)) {}

  void TakeAnswer(const qwsm::team::CloudAnswer& answer) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeAnswer(answer);
  }
  void TakeReport(const qwsm::team::CloudAnswer& answer) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeReport(answer);
  }
  void TakeRestored(const qwsm::team::CloudAnswer& answer) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeRestored(answer);
  }
  void TakeMap(const qwsm::team::CloudMap& map) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeMap(map);
  }
  void TakeStatus(const qwsm::team::TeamStatus& status) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeStatus(status);
  }
  void TakeEvent(const qwsm::team::TeamEvent& event) override {
    for (qwsm::team::CloudSink* sink : sinks_) sink->TakeEvent(event);
  }

 private:
  std::vector<qwsm::team::CloudSink*> sinks_;
};

/// Turns what is worth a line into messages.
class CloudLog final : public qwsm::team::CloudSink {
 public:
  void TakeAnswer(const qwsm::team::CloudAnswer&) override {}
  void TakeReport(const qwsm::team::CloudAnswer&) override {}
  void TakeRestored(const qwsm::team::CloudAnswer&) override {}
  void TakeMap(const qwsm::team::CloudMap&) override {}
  void TakeStatus(const qwsm::team::TeamStatus& status) override { log_.TakeStatus(status); }
  void TakeEvent(const qwsm::team::TeamEvent& event) override { log_.TakeEvent(event); }

 private:
  qwsm::pipeline::TeamLog log_;
};

}  // namespace slam6d::pipeline
