// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>

#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm::io {

/// Writes one line `t x y z qx qy qz qw` of a TUM trajectory: seconds with nine decimals, metres
/// and a unit quaternion with all their digits, z and roll and pitch being zero.
void WriteTumLine(std::ostream& stream, const StampedPose2& pose);

/// Writes a TUM trajectory, one line per pose, in their order.
/// @throws WriteError where it cannot be written.
void WriteTumFile(const std::filesystem::path& path, const Trajectory& trajectory);

/// Writes a trajectory as KITTI's odometry benchmark has it, without stamps: one line per pose, the
/// upper three rows of its 4x4 matrix, x forward and z up.
/// @throws WriteError where it cannot be written.
void WriteKittiFile(const std::filesystem::path& path, const Trajectory& trajectory);

/// Reads a TUM trajectory; `#` begins a comment. Of poses in space x, y and yaw are kept.
/// @throws std::runtime_error with file:line where a line is no pose.
Trajectory ReadTum(std::istream& stream, std::string_view name);
Trajectory ReadTumFile(const std::filesystem::path& path);

}  // namespace qwsm::io
