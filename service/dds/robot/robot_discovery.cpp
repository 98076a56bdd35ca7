// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/robot_discovery.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {

RobotDiscovery::RobotDiscovery(const Participant& participant,
                               std::vector<std::string> parts,
                               std::string type)
    : parts_(std::move(parts)), type_(std::move(type)), publications_(participant) {
  std::ranges::sort(parts_, std::greater(), &std::string::size);
}

RobotDiscovery::Changes RobotDiscovery::Take() {
  Changes changes;
  publications_.TakeAll([&](const Publication& publication) { Note(publication, changes); });
  // Who came and has gone again since then has not joined.
  std::erase_if(changes.joined,
                [this](const std::string& robot) { return publishers_of_[robot] == 0; });
  return changes;
}

// Of `rear/scan` and `scan` the longer one is meant: there is no robot `rear`.
std::optional<std::string> RobotDiscovery::RobotOf(std::string_view topic) const {
  for (const std::string& part : parts_) {
    if (std::optional<std::string> robot = RobotNames::RobotOf(topic, part)) return robot;
  }
  return std::nullopt;
}

void RobotDiscovery::Note(const Publication& publication, Changes& changes) {
  if (!publication.is_alive) {
    const auto gone = robot_of_.extract(publication.writer);
    if (!gone || --publishers_of_[gone.mapped()] > 0) return;
    unreliable_.erase(gone.mapped());
    changes.left.push_back(gone.mapped());
    return;
  }
  if (robot_of_.contains(publication.writer) || publication.type != type_) return;
  const std::optional<std::string> robot = RobotOf(publication.topic);
  if (!robot) return;
  robot_of_[publication.writer] = *robot;
  if (!publication.is_reliable) unreliable_.insert(*robot);
  if (++publishers_of_[*robot] == 1) changes.joined.push_back(*robot);
}

}  // namespace qwsm::dds
