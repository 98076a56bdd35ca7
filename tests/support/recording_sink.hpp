// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "service/team/sinks/team_sink.hpp"

namespace qwsm::test {

/// Keeps all that a team service tells.
class RecordingSink : public team::TeamSink {
 public:
  void TakeAnswer(const team::RobotAnswer& answer) override {
    const std::lock_guard lock(mutex_);
    steps_[answer.robot].push_back(answer.step);
    std::vector<std::string>& components = components_[answer.robot];
    if (components.empty() || components.back() != answer.component) {
      components.push_back(answer.component);
    }
  }
  void TakeReport(const team::RobotAnswer& answer) override {
    const std::lock_guard lock(mutex_);
    reports_[answer.robot].push_back(answer.step);
  }
  void TakeRelevantScan(const team::TeamScan& scan) override {
    const std::lock_guard lock(mutex_);
    relevant_.push_back(scan);
  }
  void TakeNewPoints(const team::NewPoints& points) override {
    const std::lock_guard lock(mutex_);
    new_points_ += points.points_map_m.size();
  }
  void TakeMap(const team::MapPicture& map) override {
    const std::lock_guard lock(mutex_);
    maps_[std::string(map.component)] = map.grid;
  }
  void TakeEpoch(const team::TeamEpoch& epoch) override {
    const std::lock_guard lock(mutex_);
    epochs_.push_back(epoch);
  }
  void TakeStatus(const team::TeamStatus& status) override {
    const std::lock_guard lock(mutex_);
    statuses_.push_back(status);
  }
  void TakeEvent(const team::TeamEvent& event) override {
    const std::lock_guard lock(mutex_);
    events_.push_back(std::string(event.robot.value_or("service")) + ": " +
                      std::string(event.text));
  }

  std::vector<MappingStep> steps(const std::string& robot) const {
    const std::lock_guard lock(mutex_);
    const auto found = steps_.find(robot);
    return found == steps_.end() ? std::vector<MappingStep>() : found->second;
  }
  /// The components of the map that the robot was answered in, one after the other.
  std::vector<std::string> components(const std::string& robot) const {
    const std::lock_guard lock(mutex_);
    return components_.at(robot);
  }
  std::vector<MappingStep> reports(const std::string& robot) const {
    const std::lock_guard lock(mutex_);
    const auto found = reports_.find(robot);
    return found == reports_.end() ? std::vector<MappingStep>() : found->second;
  }
  /// @pre the robot was answered.
  MappingStep last_step(const std::string& robot) const {
    const std::lock_guard lock(mutex_);
    return steps_.at(robot).back();
  }
  std::vector<team::TeamScan> relevant() const {
    const std::lock_guard lock(mutex_);
    return relevant_;
  }
  std::vector<team::TeamEpoch> epochs() const {
    const std::lock_guard lock(mutex_);
    return epochs_;
  }
  std::size_t new_points() const {
    const std::lock_guard lock(mutex_);
    return new_points_;
  }
  std::map<std::string, OccupancyGrid> maps() const {
    const std::lock_guard lock(mutex_);
    return maps_;
  }
  std::size_t statuses() const {
    const std::lock_guard lock(mutex_);
    return statuses_.size();
  }
  std::ptrdiff_t CountEvents(const std::string& event) const {
    const std::lock_guard lock(mutex_);
    return std::ranges::count(events_, event);
  }
  bool HasEvent(const std::string& event) const { return CountEvents(event) > 0; }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<MappingStep>> steps_;
  std::map<std::string, std::vector<std::string>> components_;
  std::map<std::string, std::vector<MappingStep>> reports_;
  std::vector<team::TeamScan> relevant_;
  std::vector<team::TeamEpoch> epochs_;
  std::size_t new_points_ = 0;
  std::map<std::string, OccupancyGrid> maps_;
  std::vector<team::TeamStatus> statuses_;
  std::vector<std::string> events_;
};

}  // namespace qwsm::test
