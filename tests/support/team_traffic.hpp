// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "sim/simulation.hpp"

namespace qwsm::test {

/// A number of robots that drive through one office and see each other.
struct TeamOptions {
  int robots = 16;
  int beams = 361;
  double rate_hz = 10.0;
  double duration_s = 60.0;
};

/// What a service's answer to a scan took.
struct TimedAnswer {
  std::chrono::system_clock::time_point heard;
  std::chrono::nanoseconds matching{};
  std::chrono::nanoseconds latency{};  ///< From arrival to pose.
};

/// What a service made of the scans that were sent to it.
struct TrafficResult {
  std::size_t sent = 0;
  std::size_t answered = 0;      ///< Reports that came back.
  std::uint64_t counted = 0;     ///< Scans that reached the service, by its own count.
  std::uint64_t dropped = 0;     ///< Of these, by its own count.
  std::size_t out_of_order = 0;  ///< Answers to an older scan than the one before of that robot.
  std::chrono::nanoseconds latest{};   ///< By how much the sender itself was late, at worst.
  std::vector<TimedAnswer> answers{};  ///< As they were heard.
  std::vector<std::chrono::nanoseconds> matching{};  ///< Per answer, sorted.
  std::vector<std::chrono::nanoseconds> latency{};   ///< From arrival to pose, sorted.
};

/// Simulated robots that publish on the network in real time.
class TeamTraffic {
 public:
  /// Simulates all of it beforehand.
  explicit TeamTraffic(const TeamOptions& options);
  ~TeamTraffic();

  /// Joins the network, tells the start poses and waits for a service that reports on all robots.
  /// @returns false where there is none in ten seconds.
  bool Join(const dds::NetworkOptions& network);
  std::size_t scans_left() const { return readings_.size() - next_; }
  /// Publishes the next so many scans at their rate times `speed`, and hears the answers until none
  /// came for two seconds. @pre 0 < scans <= scans_left()
  TrafficResult Run(std::size_t scans, double speed);

 private:
  struct Robot;

  /// @returns whether there was an answer.
  bool Hear(std::chrono::nanoseconds timeout, TrafficResult& result);

  double period_s_;
  std::vector<sim::Reading> readings_;
  std::size_t next_ = 0;  // Of these, to be published.
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<dds::MatchReportReader> reports_;
  std::vector<std::unique_ptr<Robot>> robots_;
};

/// The element at that share of a sorted list. @pre !sorted.empty()
std::chrono::nanoseconds Quantile(const std::vector<std::chrono::nanoseconds>& sorted,
                                  double share);

}  // namespace qwsm::test
