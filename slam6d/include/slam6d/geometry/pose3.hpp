// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace slam6d {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid motion of space, SE(3), right-handed. `T_a_b` is the pose of frame b in frame a; it maps
/// coordinates in b to coordinates in a: `p_a = T_a_b * p_b`.
struct Pose3 {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();

  Pose3 Inverse() const;
};

/// Chains two motions: T_a_c = T_a_b * T_b_c.
Pose3 operator*(const Pose3& T_a_b, const Pose3& T_b_c);

/// Maps a point from frame b to frame a, in metres: p_a = T_a_b * p_b.
Eigen::Vector3d operator*(const Pose3& T_a_b, const Eigen::Vector3d& p_b_m);

/// A pose and how far it may be from the truth.
///
/// `covariance` is of (x, y, z, roll, pitch, yaw) in m^2, m rad and rad^2: the translation along
/// the axes of the parent frame a, the small rotations about those axes through the origin of b.
struct UncertainPose3 {
  Pose3 T_a_b;
  Matrix6d covariance = Matrix6d::Zero();
};

/// The translation, and the rotation vector, from the second pose to the first along the axes of
/// their parent frame, as covariances are of.
Vector6d Difference(const Pose3& a, const Pose3& b);

/// The matrix with `Skew(a) * b == a.cross(b)`.
Eigen::Matrix3d Skew(const Eigen::Vector3d& a);

/// The 6x6 matrix that turns vectors of (translation, rotation): R twice on the diagonal.
Matrix6d BlockRotation(const Eigen::Matrix3d& R);

/// The rotation by |v| about v (Rodrigues), and its inverse with |v| in [0, pi].
Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& rotation_vector_rad);
Eigen::Vector3d RotationVector(const Eigen::Matrix3d& rotation);

/// Angle of the rotation in [0, pi]; as exact near 0 as elsewhere.
double RotationAngle(const Eigen::Matrix3d& rotation);

/// Rz(yaw) Ry(pitch) Rx(roll), and its inverse: the angles of REP 103 with pitch in [-pi/2, pi/2].
Eigen::Matrix3d RotationFromRollPitchYaw(const Eigen::Vector3d& roll_pitch_yaw_rad);
Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& rotation);

/// The rotation nearest to `nearly`; long products of rotations are brought back by it.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& nearly);

/// The rotation of a quaternion (x, y, z, w) of any length, rounded to 1e-13 rad, and its inverse.
/// Rounded so, a rotation that has been on the way as a quaternion once comes back the
/// same to the last bit every time after. Not finite where the quaternion has no direction.
Eigen::Matrix3d RotationFromQuaternion(const Eigen::Vector4d& xyzw);
Eigen::Vector4d QuaternionOf(const Eigen::Matrix3d& rotation);

/// The pose at `share` of the way from identity to `motion`: translation and rotation vector
/// scaled.
Pose3 ScaledMotion(const Pose3& motion, double share);

/// The pose at `share` of the way from a (0) to b (1), by even motion.
inline Pose3 Between(const Pose3& a, const Pose3& b, double share) {
  return a * ScaledMotion(a.Inverse() * b, share);
}

/// Whether all numbers are finite.
bool IsFinite(const Pose3& pose);

/// The pose of c in a, from that of b in a and that of c in b, whose errors are independent.
UncertainPose3 operator*(const UncertainPose3& a_b, const UncertainPose3& b_c);

}  // namespace slam6d
