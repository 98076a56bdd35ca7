// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/entities/reader.hpp"
#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "tests/support/network.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::test {

/// A robot on the network that drives round and round in the room of ObservationInRoom(), and
/// listens to whatever service answers it. One in a process, made after its child processes' first.
class RobotInRoom {
 public:
  explicit RobotInRoom(const PrivateNetwork& network, const std::string& name = "robot1")
      : participant_({.interface = "lo", .tag = network.tag()}),
        publisher_(participant_, dds::RobotNames(name), dds::OdometryUse::kPublished),
        reports_(participant_, {name}),
        shared_(participant_, dds::kSharedScansTopic, dds::Profile::kSharedScans),
        health_(participant_, dds::kDiagnosticsTopic, dds::Profile::kAnswerIn) {}

  /// There is one in a process.
  const dds::Participant& participant() const { return participant_; }

  /// The next scan of its way, ten of which make a second.
  Observation NextObservation() { return ObservationInRoom(scan_++); }
  void Publish(const Observation& observation) { publisher_.Publish(observation); }

  /// Tells where it is, as an operator would.
  void Tell(const UncertainPose2& map_robot) { publisher_.TellPose({}, map_robot); }
  /// Where it is, as its odometry says, which begins with the map.
  Pose2 T_map_robot() const { return *ObservationInRoom(scan_ - 1).T_odom_robot; }

  /// What a service reported for so long.
  std::vector<dds::MatchReport> Hear(std::chrono::milliseconds period) {
    const auto until = std::chrono::steady_clock::now() + period;
    std::vector<dds::MatchReport> heard;
    while (std::chrono::steady_clock::now() < until) {
      std::vector<dds::MatchReport> some = reports_.Take(until - std::chrono::steady_clock::now());
      std::ranges::move(some, std::back_inserter(heard));
    }
    return heard;
  }
  /// Publishes the next scan and hears for as long.
  std::vector<dds::MatchReport> Drive(
      std::chrono::milliseconds period = std::chrono::milliseconds(5)) {
    Publish(NextObservation());
    return Hear(period);
  }
  /// Drives until a service has answered so many scans more. @returns the last report, if any came.
  std::vector<dds::MatchReport> DriveUntilAnswered(std::size_t scans) {
    std::vector<dds::MatchReport> heard;
    for (int i = 0; i < 4000 && heard.size() < scans; ++i) {
      std::ranges::move(Drive(), std::back_inserter(heard));
    }
    return heard;
  }
  /// As DriveUntilAnswered(), and hears until nothing comes any more: what comes after that answers
  /// later scans.
  /// @returns whether so many were answered.
  bool DriveUntilAllAreAnswered(std::size_t scans) {
    const bool answered = DriveUntilAnswered(scans).size() >= scans;
    while (!Hear(std::chrono::milliseconds(300)).empty()) {
    }
    return answered;
  }

  /// Relevant scans that services offer, since the last call.
  std::vector<team::TeamScan> TakeSharedScans() const {
    std::vector<team::TeamScan> scans;
    shared_.TakeAll([&](const dds::wire::RelevantScan& sample) {
      if (dds::ObjectionTo(sample).empty()) scans.push_back(dds::FromWire(sample));
    });
    return scans;
  }
  /// The newest state of a part of the service, such as `qwsm: journal`: its values, and its
  /// message by the key "message".
  std::map<std::string, std::string> HealthOf(const std::string& part) {
    health_.TakeAll([this](const dds::wire::DiagnosticArray& sample) { Note(sample); });
    return newest_[part];
  }
  /// Drives until a value of a part's state is as wanted. @returns false after ten seconds.
  template <class Wanted>
  bool DriveUntil(const std::string& part, const std::string& key, Wanted&& wanted) {
    for (int i = 0; i < 1000; ++i) {
      Drive(std::chrono::milliseconds(10));
      const std::map<std::string, std::string> health = HealthOf(part);
      if (const auto found = health.find(key); found != health.end() && wanted(found->second)) {
        return true;
      }
    }
    return false;
  }

 private:
  void Note(const dds::wire::DiagnosticArray& sample) {
    for (std::uint32_t i = 0; i < sample.status._length; ++i) {
      const dds::wire::DiagnosticStatus& status = sample.status._buffer[i];
      std::map<std::string, std::string>& values = newest_[status.name];
      values = {{"message", status.message}};
      for (std::uint32_t k = 0; k < status.values._length; ++k) {
        values[status.values._buffer[k].key] = status.values._buffer[k].value;
      }
    }
  }

  dds::Participant participant_;
  dds::RobotPublisher publisher_;
  dds::MatchReportReader reports_;
  dds::Reader<dds::wire::RelevantScan> shared_;
  dds::Reader<dds::wire::DiagnosticArray> health_;
  std::map<std::string, std::map<std::string, std::string>> newest_;
  int scan_ = 0;
};

}  // namespace qwsm::test
