// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "service/dds/service/ros_graph.hpp"

namespace qwsm::dds {

/// Holds what there is on the network for each robot. Any thread may ask; what stands in the list
/// never changes.
template <class Topics>
class TopicsByRobot {
 public:
  /// Starts with no robots. @param graph shows what there is; outlives this.
  explicit TopicsByRobot(const RosGraph& graph) : graph_(graph) {}

  /// The robot's topics; they are made of the arguments where there are none yet.
  template <class... Arguments>
  std::shared_ptr<const Topics> Add(std::string_view robot, Arguments&&... arguments) {
    const std::lock_guard lock(mutex_);
    if (const auto known = by_robot_.find(robot); known != by_robot_.end()) return known->second;
    auto topics = std::make_shared<const Topics>(std::forward<Arguments>(arguments)...);
    by_robot_.emplace(robot, topics);
    graph_.Announce();
    return topics;
  }
  void Remove(const std::string& robot) {
    const std::lock_guard lock(mutex_);
    by_robot_.erase(robot);
    graph_.Announce();
  }
  /// The robot's topics; null where there are none.
  std::shared_ptr<const Topics> Find(std::string_view robot) const {
    const std::lock_guard lock(mutex_);
    const auto known = by_robot_.find(robot);
    return known == by_robot_.end() ? nullptr : known->second;
  }

 private:
  const RosGraph& graph_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Topics>, std::less<>> by_robot_;
};

}  // namespace qwsm::dds
