// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/entities/publications.hpp"

namespace qwsm::dds {

/// Finds out which robots there are, by who publishes on a topic such as `/robot1/scan`.
class RobotDiscovery {
 public:
  /// Robots that have left, and after that those that have joined: one that has done both in the
  /// meantime is there.
  struct Changes {
    std::vector<std::string> left;    ///< Names of robots for which nobody published any more.
    std::vector<std::string> joined;  ///< Names of robots, as in RobotNames.
  };

  /// Looks for topics.
  /// @param parts last parts of the topics' names, as `scan` and `rear/scan`.
  /// @param type their DDS type: topics of other types are passed over.
  RobotDiscovery(const Participant& participant, std::vector<std::string> parts, std::string type);

  /// Robots that have joined or left since the last call.
  Changes Take();
  /// Whether the publishers of a robot repeat what was lost, as far as they are known.
  bool IsReliable(const std::string& robot) const { return !unreliable_.contains(robot); }
  Entity::Handle handle() const { return publications_.handle(); }

 private:
  void Note(const Publication& publication, Changes& changes);

  std::optional<std::string> RobotOf(std::string_view topic) const;

  std::vector<std::string> parts_;  // The longest first.
  std::string type_;
  Publications publications_;
  std::map<Guid, std::string> robot_of_;      // Robot, by publisher.
  std::map<std::string, int> publishers_of_;  // Number of publishers, by robot.
  std::set<std::string> unreliable_;  // Robots whose publishers do not repeat what was lost.
};

}  // namespace qwsm::dds
