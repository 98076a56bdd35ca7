// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <span>
#include <vector>

#include "qwsm/metrics/stamped_pose.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/team/scans/map_version.hpp"

namespace qwsm::pipeline {

/// What a robot was answered in one version of a map.
struct AnsweredStretch {
  team::MapVersion version;
  Timestamp since{};    ///< Stamp of the first answer.
  Trajectory relevant;  ///< Where relevant scans were answered.
};

/// A map as it is now, and where it has a robot's relevant scans, by their stamps.
struct ScansInMap {
  team::MapVersion version;
  std::map<Timestamp, Pose2> T_map_robot;
};

/// The path of a robot in the map as it is now: since it was answered the map was corrected, or the
/// component that the robot was in has joined it. What was answered in another version keeps its
/// place beside the relevant scan of that version that is nearest in time; where the map has none,
/// the answer is left out.
/// @param stretches in the order of the answers. @pre one begins with the first answer
std::vector<io::PathPose> PathInMap(std::span<const io::PathPose> answered,
                                    std::span<const AnsweredStretch> stretches,
                                    const ScansInMap& now);

}  // namespace qwsm::pipeline
