// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/scan_recorder.hpp"

#include <utility>

namespace qwsm::pipeline {
namespace {

constexpr auto kPatienceForOdometry = std::chrono::milliseconds(500);

}  // namespace

bool ScanRecorder::TakeScan(std::string_view, LaserScan scan) {
  waiting_.push_back({.scan = std::move(scan), .arrived = Clock::now()});
  return true;
}

void ScanRecorder::TakeOdometry(std::string_view, Timestamp stamp, const Pose2& T_odom_robot) {
  odometry_.Add(stamp, T_odom_robot);
}

void ScanRecorder::ExpectOdometry(std::string_view, bool expected) { expects_odometry_ = expected; }

void ScanRecorder::WriteReady() {
  const Clock::time_point now = Clock::now();
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    const bool may_come = expects_odometry_ && !odometry_.Covers(first.scan.stamp) &&
                          now - first.arrived < kPatienceForOdometry;
    if (may_come) return;
    WriteFirst();
  }
}

void ScanRecorder::Finish() {
  while (!waiting_.empty()) WriteFirst();
}

void ScanRecorder::WriteFirst() {
  LaserScan& scan = waiting_.front().scan;
  const std::optional<Pose2> T_odom_robot = odometry_.At(scan.stamp);
  write_(io::ScanReading{.scan = std::move(scan), .T_odom_robot = T_odom_robot, .laser = "front"});
  waiting_.pop_front();
  ++scans_;
}

}  // namespace qwsm::pipeline
