// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "service/team/marks/mark.hpp"

namespace qwsm::team {

/// Where a robot was when it took a scan.
struct ScanPlace {
  std::string robot;
  Timestamp stamp{};
  Pose2 T_map_robot;
};

/// All marks that are known, and the scans that they stand on. Used by one thread at a time.
class MarkBook {
 public:
  static constexpr std::size_t kMostMarks = 1024;

  /// Takes a mark, by whomever, if it is the newest of its id and there is room for it.
  /// @returns whether it was taken. @pre ObjectionTo(mark).empty()
  bool Take(const Mark& mark);
  /// Marks that were removed give way to others, the oldest first, where there are too many.
  bool HasRoomFor(const Mark& mark) const;
  /// What is known of an id; null where nothing is.
  const Mark* Find(const std::string& id) const;

  /// The mark with a number, and on the nearest scan: as an operator has just put it there.
  /// O(scans).
  Mark Completed(Mark mark) const;

  /// Learns where scans are, and moves the marks that stand on them: after a correction of the map,
  /// give it all that was corrected.
  /// @returns the marks that have moved, of a new revision.
  std::vector<Mark> Place(std::span<const ScanPlace> places);

  /// Sees to it that no two marks have one number, once marks of others have come (NumberApart).
  /// @returns the marks that have got a new one.
  std::vector<Mark> NumberApart();

  std::vector<Mark> marks() const;

 private:
  std::map<std::string, Mark>::const_iterator OldestRemoved() const;

  std::map<std::string, Mark> marks_;                         // By their ids.
  std::map<std::string, std::map<Timestamp, Pose2>> places_;  // T_map_robot of scans, by robot.
};

/// The marks, each of an id once, where the scans are that they stand on.
std::vector<Mark> PlacedOn(std::span<const ScanPlace> places, std::span<const Mark> marks);

}  // namespace qwsm::team
