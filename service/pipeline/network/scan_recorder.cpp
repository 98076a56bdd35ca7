// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/scan_recorder.hpp"

#include <algorithm>
#include <utility>

#include "service/team/session/deskewing.hpp"

namespace qwsm::pipeline {
namespace {

constexpr auto kPatienceForOdometry = std::chrono::milliseconds(500);
constexpr std::size_t kMostLasersOfLog = 5;

}  // namespace

bool ScanRecorder::TakeScan(std::string_view, LaserScan scan) {
  waiting_.push_back({.scan = std::move(scan), .arrived = Clock::now()});
  return true;
}

void ScanRecorder::TakeOdometry(std::string_view, Timestamp stamp, const Pose2& T_odom_robot) {
  odometry_.Add(stamp, T_odom_robot);
}

void ScanRecorder::TakeImu(std::string_view, const ImuReading& reading) {
  if (gyro_.Add(reading)) write_(reading);
}

void ScanRecorder::ExpectOdometry(std::string_view, bool expected) { expects_odometry_ = expected; }

void ScanRecorder::WriteReady() {
  const Clock::time_point now = Clock::now();
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    const bool may_come = expects_odometry_ && !odometry_.Covers(team::EndOf(first.scan)) &&
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
  const Pose2 mounting = scan.geometry.T_robot_laser;
  scan = team::AsFromOnePlace(std::move(scan), odometry_, gyro_);
  write_(io::ScanReading{
      .scan = std::move(scan), .T_odom_robot = T_odom_robot, .laser = NameOf(mounting)});
  waiting_.pop_front();
  ++scans_;
}

// A log has five lasers: who is mounted anew more often goes by the last name.
std::string ScanRecorder::NameOf(const Pose2& T_robot_laser) {
  auto known = std::ranges::find(T_robot_laser_, T_robot_laser);
  if (known == T_robot_laser_.end() && T_robot_laser_.size() == kMostLasersOfLog) --known;
  if (known == T_robot_laser_.end()) known = T_robot_laser_.insert(known, T_robot_laser);
  const auto number = known - T_robot_laser_.begin() + 1;
  return number == 1 ? "front" : number == 2 ? "rear" : "laser" + std::to_string(number);
}

}  // namespace qwsm::pipeline
