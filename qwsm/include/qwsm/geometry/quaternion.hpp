// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace qwsm {

/// A rotation of space as ROS writes it, of unit length or nearly so.
struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;
};

/// A rotation about z whose YawOf() is `theta_rad` to the last bit, so that a pose that was written
/// as a quaternion comes back as it was. @pre -pi < theta_rad <= pi
Quaternion QuaternionOf(double theta_rad);

/// Rotation about z of a quaternion of any length, in rad; 0 where it has none.
double YawOf(const Quaternion& rotation);

/// Cosine of the angle by which the rotation tilts the z axis; NaN where it is no rotation.
double UprightnessOf(const Quaternion& rotation);

/// The rotation `a` after the rotation `b`: R(a b) = R(a) R(b).
Quaternion operator*(const Quaternion& a, const Quaternion& b);

}  // namespace qwsm
