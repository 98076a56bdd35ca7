// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/entities/wire_types.hpp"
#include "slam6d/geometry/pose3.hpp"

/// Poses and covariances of space on the wire.
namespace qwsm::dds {

/// A pose as a sample. One that was sent once comes back the same to the last bit every time after;
/// see slam6d::RotationFromQuaternion().
wire::Pose ToWire(const slam6d::Pose3& pose);
/// The pose of a sample. Not finite where the sample's rotation is none.
slam6d::Pose3 SpatialPose(const wire::Pose& pose);

/// Writes a spatial covariance into that of a sample, row by row of (x, y, z, roll, pitch, yaw).
void CopyCovariance(const slam6d::Matrix6d& covariance, double (&of_six)[36]);
slam6d::Matrix6d SpatialCovariance(const double (&of_six)[36]);

}  // namespace qwsm::dds
