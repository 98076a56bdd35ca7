// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/geometry/quaternion.hpp"

namespace qwsm::io {

/// Where a frame sits in another, in space, as messages have it.
struct Transform3 {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  Quaternion rotation;

  Transform3 Inverse() const;
};

/// T_a_c = T_a_b * T_b_c.
Transform3 operator*(const Transform3& T_a_b, const Transform3& T_b_c);

/// Whether all numbers are those of a place and of a rotation.
bool IsSound(const Transform3& transform);

/// What is left of it in the plane: height and tilt are dropped.
inline Pose2 Planar(const Transform3& transform) {
  return {transform.x_m, transform.y_m, YawOf(transform.rotation)};
}

/// A pose in the plane, which Planar() gives back to the last bit.
inline Transform3 Spatial(const Pose2& pose) {
  return {.x_m = pose.x_m, .y_m = pose.y_m, .z_m = 0.0, .rotation = QuaternionOf(pose.theta_rad)};
}

}  // namespace qwsm::io
