// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/robot_path.hpp"

#include <algorithm>
#include <iterator>

namespace qwsm::pipeline {

void RobotPath::Take(const team::RobotAnswer& answer) {
  const MappingStep& step = answer.step;
  std::optional<UncertainPose2> map_last;
  if (answer.last_relevant) {
    // A scan that had to wait for the end of a trial is none of the answers told as relevant.
    if (nodes_.empty() || nodes_.back() != answer.last_relevant->stamp) {
      path_.TakeNode();
      nodes_.push_back(answer.last_relevant->stamp);
    }
    map_last = answer.last_relevant->map_robot;
  }
  if (!step.relevant && !map_last) unanchored_[taken_.size()] = step.map_robot;
  if (stretches_.empty() || stretches_.back().map != answer.version.map) {
    stretches_.push_back({.since = step.stamp, .map = answer.version.map});
  }
  path_.Take(step, map_last);
  if (step.relevant) nodes_.push_back(step.relevant_scan.stamp);
  taken_.push_back({.stamp = step.stamp, .status = step.status});
}

std::vector<std::optional<UncertainPose2>> RobotPath::In(const RobotInMap& end) const {
  std::vector<std::optional<UncertainPose2>> map_node(nodes_.size());
  auto node = end.map_robot.end();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const bool is_at_same_time = i > 0 && nodes_[i] == nodes_[i - 1] && node != end.map_robot.end();
    node = is_at_same_time ? std::next(node) : end.map_robot.lower_bound(nodes_[i]);
    if (node != end.map_robot.end() && node->first == nodes_[i]) map_node[i] = node->second;
  }
  std::vector<std::optional<UncertainPose2>> placed = path_.At(map_node);
  for (const auto& [i, map_robot] : unanchored_) {
    if (MapAt(taken_[i].stamp) == end.map) placed[i] = map_robot;
  }
  return placed;
}

std::vector<io::PathPose> RobotPath::PathOf(
    std::span<const std::optional<UncertainPose2>> map_robot) const {
  std::vector<io::PathPose> path;
  path.reserve(map_robot.size());
  for (std::size_t i = 0; i < map_robot.size(); ++i) {
    if (!map_robot[i]) continue;
    path.push_back(
        {.stamp = taken_[i].stamp, .map_robot = *map_robot[i], .status = taken_[i].status});
  }
  return path;
}

std::optional<std::uint64_t> RobotPath::MapAt(Timestamp stamp) const {
  const auto next = std::ranges::upper_bound(stretches_, stamp, {}, &Stretch::since);
  if (next == stretches_.begin()) return std::nullopt;
  return std::prev(next)->map;
}

}  // namespace qwsm::pipeline
