// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Standard deviations of the motion between two scans, as told by odometry.
struct MotionNoise {
  double translation_floor_m = 0.03;
  double translation_per_translation = 0.15;
  double translation_per_rotation_m = 0.05;
  double rotation_floor_rad = 0.0175;
  double rotation_per_rotation = 0.2;
  double rotation_per_translation_rad = 0.0525;
  double without_odometry = 2.0;
};

template <class Visitor>
void Describe(Visitor& visit, MotionNoise& o) {
  visit("translation_floor_m",
        o.translation_floor_m,
        {.help = "sigma of the position between scans, at rest", .min = 1e-4, .max = 10});
  visit("translation_per_translation",
        o.translation_per_translation,
        {.help = "more of it per metre moved", .min = 0, .max = 10});
  visit("translation_per_rotation_m",
        o.translation_per_rotation_m,
        {.help = "more of it per radian turned", .min = 0, .max = 10});
  visit("rotation_floor_rad",
        o.rotation_floor_rad,
        {.help = "sigma of the heading between scans, at rest", .min = 1e-4, .max = 3});
  visit("rotation_per_rotation",
        o.rotation_per_rotation,
        {.help = "more of it per radian turned", .min = 0, .max = 10});
  visit("rotation_per_translation_rad",
        o.rotation_per_translation_rad,
        {.help = "more of it per metre moved", .min = 0, .max = 3});
  visit("without_odometry",
        o.without_odometry,
        {.help = "factor on all of it where only the last motion is known", .min = 1, .max = 100});
}

/// Predicts how the robot moved since the last scan: by odometry, or as it moved before.
class MotionModel {
 public:
  explicit MotionModel(const MotionNoise& noise = {}) : noise_(noise) {}

  /// Pose of the robot now in its own last frame; covariance in that frame.
  UncertainPose2 Predict(const std::optional<Pose2>& T_odom_robot) const;

  /// Tells how the robot really moved, and with which odometry reading.
  void Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot);

  /// Tells how the robot was found to have moved. Odometry that keeps missing it by more than
  /// modelled is believed less (Mehra 1970).
  void Learn(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot);

 private:
  // Factor on the modelled variance.
  double Doubt() const;

  MotionNoise noise_;
  std::optional<Pose2> T_odom_last_;
  double misfit_ = 0.0;  // Running mean of squared errors, in units of the modelled variance.
  Pose2 T_last_robot_;   // The last motion, for when there is no odometry.
};

}  // namespace qwsm
