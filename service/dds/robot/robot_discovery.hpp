// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "service/dds/entities/publications.hpp"

namespace qwsm::dds {

/// Finds out which robots there are, by who publishes on a topic such as `/robot1/scan`.
class RobotDiscovery {
 public:
  static constexpr std::size_t kMaxRobots = 256;  ///< More are not a team but an attack.

  struct Changes {
    std::vector<std::string> joined;  ///< Names of robots, as in RobotNames.
    std::vector<std::string> left;    ///< Nobody publishes for them any more.
  };

  /// @param part last part of the topic's name. @param type its DDS type: others are passed over.
  RobotDiscovery(const Participant& participant, std::string part, std::string type);

  /// What changed since the last call.
  Changes Take();
  /// Whether the publishers of a robot repeat what was lost, as far as they are known.
  bool IsReliable(const std::string& robot) const { return !unreliable_.contains(robot); }
  Entity::Handle handle() const { return publications_.handle(); }

 private:
  void Note(const Publication& publication, Changes& changes);

  std::string part_;
  std::string type_;
  Publications publications_;
  std::map<Guid, std::string> robot_of_;      // By publisher.
  std::map<std::string, int> publishers_of_;  // By robot.
  std::set<std::string> unreliable_;          // Robots.
};

}  // namespace qwsm::dds
