// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "service/team/session/correction_options.hpp"

namespace qwsm::team {

/// Passes corrections of the map on to who drives by `map` -> `odom`, by a policy.
///
/// Matching goes on in the corrected map at once. What is told is seen from a map that lies where
/// the robot last knew it, `T_told_map`, which comes to the corrected one as the policy says. The
/// two are the same as long as nothing is corrected, and then nothing is computed.
class CorrectionEasing {
 public:
  explicit CorrectionEasing(const CorrectionOptions& options) : options_(options) {}

  /// Learns that a correction has moved the robot, at one moment, from one pose to another.
  void Correct(const Pose2& T_map_robot_before, const Pose2& T_map_robot);

  /// The robot has been placed anew: what is told is where it is.
  void Forget() { T_told_map_.reset(); }

  /// What to tell of a scan's answer; nothing where that is the answer.
  /// @param T_odom_robot odometry of the scan, if there is any.
  std::optional<UncertainPose2> Tell(const MappingStep& step,
                                     const std::optional<Pose2>& T_odom_robot);

 private:
  /// Since when the robot is about here, in the frame of odometry or, without, of the map.
  struct Stay {
    Timestamp since{};
    bool is_by_odometry = false;
    Pose2 T_frame_robot{};
  };

  bool Stands(const MappingStep& step, const std::optional<Pose2>& T_odom_robot);
  void Slew(const MappingStep& step);

  const CorrectionOptions options_;
  std::optional<Pose2> T_told_map_;  // Nothing where it is told what is.
  std::optional<Stay> stay_;
  std::optional<Timestamp> told_;  // When something was told last.
};

}  // namespace qwsm::team
