// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/dds/entities/wire_types.hpp"

/// Times, poses and covariances of the plane on the wire, where all is three-dimensional.
namespace qwsm::dds {

/// The time of a sample; nothing where it has more than a second of nanoseconds.
std::optional<Timestamp> FromWire(const wire::Time& time);
/// The time of a stamp on the wire. @pre the stamp is within 2^31 seconds.
wire::Time ToWire(Timestamp stamp);
/// A duration in nanoseconds; 0 where there is no such duration: a day and more.
std::chrono::nanoseconds Nanoseconds(double duration_s);

/// A rotation about z whose YawOf() is `theta_rad` to the last bit, so that a replayed log gives
/// the poses of the log itself. @pre -pi < theta_rad <= pi
wire::Quaternion QuaternionOf(double theta_rad);
/// Rotation about z of a quaternion of any length, in rad; 0 where it has none.
double YawOf(const wire::Quaternion& rotation);
/// Cosine of the angle by which the rotation tilts the z axis.
double UprightnessOf(const wire::Quaternion& rotation);

wire::Pose ToWire(const Pose2& pose);
/// The pose in the plane of a sample; height, roll and pitch are left out.
Pose2 FromWire(const wire::Pose& pose);
wire::Pose2D ToWire2D(const Pose2& pose);
Pose2 FromWire(const wire::Pose2D& pose);

/// Writes a planar covariance into the 6x6 of a sample, row by row of (x, y, z, roll, pitch, yaw).
void CopyCovariance(const Eigen::Matrix3d& of_x_y_theta, double (&of_six)[36]);
Eigen::Matrix3d PlanarCovariance(const double (&of_six)[36]);
void CopyCovariance(const Eigen::Matrix3d& of_x_y_theta, double (&of_three)[9]);
Eigen::Matrix3d CovarianceOf(const double (&of_three)[9]);

/// A string for a sample that is written while `text` lives.
inline char* Borrow(const std::string& text) { return const_cast<char*>(text.c_str()); }

/// Says why a sample with this header must not be used; empty if it may.
std::string_view ObjectionTo(const wire::Header& header);
/// A header for a sample that is written while `frame` lives.
wire::Header HeaderOf(Timestamp stamp, const std::string& frame);

}  // namespace qwsm::dds
