// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// By what share of the way that its wheels tell a robot goes less far. Tyres creep while they
/// push, on grass by a few percent of the way, and wheels are not quite as large as is thought.
///
/// Learned from where matches find the robot, by a Kalman filter of one state that walks at random
/// with the ground that passes by.
class WheelCreep {
 public:
  /// The motion that the wheels tell, as far as the robot went.
  Pose2 TakenOut(const Pose2& told) const;

  /// Takes a motion after which the robot was found elsewhere than expected.
  /// @param before where the robot was; in the frame of the match, like `found`.
  /// @param motion since then, its creep taken out.
  void Learn(const UncertainPose2& before,
             const UncertainPose2& motion,
             const UncertainPose2& found);

  double share() const { return share_; }

 private:
  double share_ = 0.0;
  double variance_ = 0.0025;  // Of 5 %, as on soft ground.
};

}  // namespace qwsm
