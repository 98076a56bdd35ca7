// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/pose_prediction.hpp"

namespace qwsm {

/// Standard deviations of the motion between two scans that odometry reads.
struct MotionNoise {
  double translation_floor_m = 0.03;
  double translation_per_translation = 0.15;
  double translation_per_rotation_m = 0.05;
  double rotation_floor_rad = 0.0175;
  double rotation_per_rotation = 0.2;
  double rotation_per_translation_rad = 0.0525;
  double without_odometry = 2.0;
  double gyro_floor_rad = 0.0005;
  double gyro_per_rotation = 0.003;
};

template <class Visitor>
void Describe(Visitor& visit, MotionNoise& o) {
  visit("translation_floor_m",
        o.translation_floor_m,
        {.help = "sigma of the position between scans, at rest", .min = 1e-4, .max = 10});
  visit("translation_per_translation",
        o.translation_per_translation,
        {.help = "sigma of the position per metre moved", .min = 0, .max = 10});
  visit("translation_per_rotation_m",
        o.translation_per_rotation_m,
        {.help = "sigma of the position per radian turned", .min = 0, .max = 10});
  visit("rotation_floor_rad",
        o.rotation_floor_rad,
        {.help = "sigma of the heading between scans, at rest", .min = 1e-4, .max = 3});
  visit("rotation_per_rotation",
        o.rotation_per_rotation,
        {.help = "sigma of the heading per radian turned", .min = 0, .max = 10});
  visit("rotation_per_translation_rad",
        o.rotation_per_translation_rad,
        {.help = "sigma of the heading per metre moved", .min = 0, .max = 3});
  visit("without_odometry",
        o.without_odometry,
        {.help = "factor on all these sigmas where only the last motion is known",
         .min = 1,
         .max = 100});
  visit(
      "gyro_floor_rad",
      o.gyro_floor_rad,
      {.help = "sigma of the heading between scans where a gyro tells it", .min = 1e-5, .max = 3});
  visit("gyro_per_rotation",
        o.gyro_per_rotation,
        {.help = "sigma of a gyro's heading per radian turned", .min = 0, .max = 10});
}

/// Predicts how the robot moved since the last scan: by odometry, or as it moved before.
class MotionModel {
 public:
  /// @param smallest_scale of the modelled variances: odometry is never believed to the last.
  explicit MotionModel(const MotionNoise& noise = {}, double smallest_scale = 0.02)
      : noise_(noise), smallest_scale_(smallest_scale) {}

  /// Says whether the heading of the next motion is a gyro's, of which is learned apart.
  void SetHeadingByGyro(bool by_gyro);

  /// Predicts the pose of the robot now in its own last frame.
  /// @param share of the time between two scans of a laser that has passed since the last scan of
  ///   any: less than 1 where several take turns, and errors at rest grow by that share only.
  PosePrediction Predict(const std::optional<Pose2>& T_odom_robot, double share = 1.0) const;

  /// A motion that odometry reads, as uncertain as it has proved to be so far.
  UncertainPose2 AsProved(const Pose2& motion, double share) const;

  /// Whether odometry tells of a motion that nobody expects who only knows the one before.
  bool IsSurprising(const std::optional<Pose2>& T_odom_robot, double share = 1.0) const;

  /// Remembers how the robot really moved between two scans of a laser, and the odometry reading of
  /// the last scan.
  void Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot);
  /// Remembers the odometry reading only.
  void RememberOdometry(const std::optional<Pose2>& T_odom_robot) { T_odom_last_ = T_odom_robot; }

  /// Adapts the noise to where the robot was found, having been expected at `predicted`. Each part
  /// is scaled as odometry proves better or worse than modelled, by the innovations (Mehra 1970),
  /// in the directions of which the pairs tell enough: along a corridor the scale would follow a
  /// single moving object.
  /// @param predicted with the adapted covariance; in the frame of the match.
  /// @param found by what the scan alone tells.
  void Adapt(const UncertainPose2& predicted,
             const UncertainPose2& found,
             const std::optional<Pose2>& T_odom_robot,
             double share = 1.0);
  /// The same for a motion that odometry read.
  void Adapt(const UncertainPose2& predicted,
             const UncertainPose2& found,
             const Pose2& motion,
             double share);

 private:
  // Rows: along x, along y, heading. Columns: at rest, per way, per turn.
  Eigen::Array33d ModelledSigmas(const Pose2& motion, double share) const;
  void UpdateScale(int axis, const Eigen::Array33d& shares, double innovation_chi2, double weight);

  MotionNoise noise_;
  double smallest_scale_;
  std::optional<Pose2> T_odom_last_;
  Pose2 T_last_robot_;  // The last motion between two scans, for when there is no odometry.
  Eigen::Array33d adapted_scale_ = Eigen::Array33d::Ones();  // Of the modelled variances.
  Eigen::Array33d samples_ = Eigen::Array33d::Zero();        // Innovations that each scale is from.
  bool is_heading_by_gyro_ = false;
  // Scale and samples of the heading by the source that does not tell it now.
  Eigen::Array<double, 1, 3> other_scale_ = Eigen::Array<double, 1, 3>::Ones();
  Eigen::Array<double, 1, 3> other_samples_ = Eigen::Array<double, 1, 3>::Zero();
};

}  // namespace qwsm
