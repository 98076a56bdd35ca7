// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/anchored_path.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/team/sinks/service_sink.hpp"

namespace qwsm::pipeline {

/// A map as it is in the end, and where it has a robot's relevant scans, by their stamps; those of
/// several lasers at the same time as they came.
struct RobotInMap {
  std::uint64_t map = 0;  ///< Number of the map, as in MapVersion.
  std::multimap<Timestamp, UncertainPose2> map_robot;
};

/// The path of a robot of a team. Since it was answered the map was corrected, or the component
/// that the robot was in has joined it: each answer keeps its place beside the robot's relevant
/// scans.
class RobotPath {
 public:
  /// Takes the answer to the next scan.
  void Take(const team::RobotAnswer& answer);

  /// Where each answer is in the map as it is in the end; none where it hangs on a scan that the
  /// map has not.
  std::vector<std::optional<UncertainPose2>> In(const RobotInMap& end) const;
  /// The path of these answers. @param map_robot as In() gives them.
  std::vector<io::PathPose> PathOf(std::span<const std::optional<UncertainPose2>> map_robot) const;
  /// Number of the map that the robot was in at a time; none before the first answer.
  std::optional<std::uint64_t> MapAt(Timestamp stamp) const;

 private:
  struct Taken {
    Timestamp stamp{};
    StepStatus status = StepStatus::kFirst;
  };
  // Answers in one map, from the first one on.
  struct Stretch {
    Timestamp since{};
    std::uint64_t map = 0;
  };

  std::vector<Taken> taken_;
  AnchoredPath path_;
  std::vector<Timestamp> nodes_;  // Stamps of the relevant scans that it hangs on.
  std::vector<Stretch> stretches_;
  // Answers from before the robot had a relevant scan in that map, by their place in the path.
  std::map<std::size_t, UncertainPose2> unanchored_;
};

}  // namespace qwsm::pipeline
