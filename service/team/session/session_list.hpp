// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "service/team/scans/robot_name.hpp"
#include "service/team/session/robot_listener.hpp"
#include "service/team/session/worker_pool.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

/// The sessions of all robots of a service, and the threads that work on their scans. All functions
/// may be called from any thread. A robot has a session from its first message on, whatever that
/// is, and joins with its first scan.
/// @tparam Session a Lane of some Kind of scans, with name(), intake() and PlaceAt().
template <class Session>
class SessionList final : public RobotListener<typename Session::Kind> {
  using Kind = typename Session::Kind;

 public:
  using Make = std::function<std::shared_ptr<Session>(std::string robot)>;

  explicit SessionList(Make make) : make_(std::move(make)) {}

  /// Starts to work. @param threads number of workers; 0: as many as the computer has cores.
  void Start(int threads) {
    const std::lock_guard lock(mutex_);
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    workers_ = std::make_unique<WorkerPool>(threads > 0 ? threads : cores);
    for (const auto& [robot, session] : sessions_) workers_->Add(session);
  }
  /// Finishes the pieces at work; what waits is left out.
  void Stop() {
    if (workers_) workers_->Stop();
  }
  void WaitUntilIdle() {
    if (workers_) workers_->WaitUntilIdle();
  }

  /// The robot's session, a new one if need be; null where there are more than any team has.
  std::shared_ptr<Session> Of(std::string_view robot) {
    const std::lock_guard lock(mutex_);
    if (const auto known = sessions_.find(robot); known != sessions_.end()) return known->second;
    if (sessions_.size() >= kMaxRobots) return nullptr;
    const std::shared_ptr<Session> session = make_(std::string(robot));
    if (workers_) workers_->Add(session);
    return sessions_[session->name()] = session;
  }

  /// Notes that a robot's publisher is there.
  void Join(std::string_view robot) {
    if (const auto session = Of(robot)) session->intake().Join();
  }
  /// Notes that a robot's publisher is gone. A robot that is not known cannot be lost.
  void Lose(std::string_view robot) {
    if (const auto session = Find(robot)) session->intake().Lose();
  }
  /// Notes that another service answers the robot from now on.
  void HandOver(std::string_view robot) {
    if (const auto session = Find(robot)) session->intake().HandOver();
  }

  void ExpectWaited(std::string_view robot, std::size_t scans) override {
    if (const auto session = Of(robot)) session->intake().ExpectWaited(scans);
  }
  /// Takes a robot's scan.
  /// @return false if it was refused: malformed, of a wrong time or a duplicate; see the robot's
  /// counts.
  bool TakeScan(std::string_view robot, typename Kind::Scan scan) override {
    return Enqueue(robot, std::move(scan), std::nullopt);
  }
  bool TakeContestedScan(std::string_view robot,
                         typename Kind::Scan scan,
                         const typename Kind::Pose& T_robot_sensor_claimed) override {
    return Enqueue(robot, std::move(scan), T_robot_sensor_claimed);
  }
  void TakeOdometry(std::string_view robot,
                    Timestamp stamp,
                    const typename Kind::Pose& T_odom_robot) override {
    const auto session = Of(robot);
    if (!session) return;
    session->intake().TakeOdometry(stamp, T_odom_robot);
    WakeFor(*session);
  }
  void ExpectOdometry(std::string_view robot, bool expected) override {
    if (const auto session = Of(robot)) session->intake().ExpectOdometry(expected);
  }
  void TakeImu(std::string_view robot, const ImuReading& reading) override {
    const auto session = Of(robot);
    if (!session) return;
    session->intake().TakeImu(reading);
    WakeFor(*session);
  }
  void ExpectImu(std::string_view robot, bool expected) override {
    if (const auto session = Of(robot)) session->intake().ExpectImu(expected);
  }
  void PlaceAt(std::string_view robot, const typename Kind::UncertainPose& map_robot) override {
    if (const auto session = Of(robot)) session->PlaceAt(map_robot);
  }

  std::vector<std::shared_ptr<Session>> All() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<Session>> all;
    for (const auto& [robot, session] : sessions_) all.push_back(session);
    return all;
  }
  std::vector<RobotStatus> Statuses() const {
    std::vector<RobotStatus> all;
    for (const auto& session : All()) all.push_back(session->intake().Status());
    return all;
  }

 private:
  std::shared_ptr<Session> Find(std::string_view robot) const {
    const std::lock_guard lock(mutex_);
    const auto found = sessions_.find(robot);
    return found == sessions_.end() ? nullptr : found->second;
  }
  bool Enqueue(std::string_view robot,
               typename Kind::Scan scan,
               const std::optional<typename Kind::Pose>& T_robot_sensor_claimed) {
    const auto session = Of(robot);
    if (!session || !session->intake().Enqueue(std::move(scan), T_robot_sensor_claimed)) {
      return false;
    }
    WakeFor(*session);
    return true;
  }
  void WakeFor(const Session& session) {
    if (!session.ReadyAt()) return;
    const std::lock_guard lock(mutex_);
    if (workers_) workers_->Wake();
  }

  Make make_;
  mutable std::mutex mutex_;  // Guards the list; sessions look after themselves.
  std::map<std::string, std::shared_ptr<Session>, std::less<>> sessions_;
  std::unique_ptr<WorkerPool> workers_;
};

}  // namespace qwsm::team
