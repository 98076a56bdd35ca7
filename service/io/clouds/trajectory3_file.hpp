// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d::io {

/// Poses by the number of their scan, or by their stamp in seconds.
using NumberedPoses = std::map<double, Pose3>;

/// Writes a TUM trajectory `n x y z qx qy qz qw`: the scan's number as its stamp, right-handed
/// metres, all digits.
/// @throws qwsm::io::WriteError where it cannot be written.
void WriteTum3(const std::filesystem::path& file, const std::vector<Pose3>& T_map_scan);

/// Writes a TUM trajectory with stamps, in seconds, instead of numbers.
/// @pre as many stamps as poses.
void WriteTum3(const std::filesystem::path& file,
               const std::vector<Pose3>& T_map_scan,
               const std::vector<qwsm::Timestamp>& stamps);

/// Writes poses as KITTI's odometry benchmark has them: one line per pose, the upper three rows of
/// its 4x4 matrix, x forward and z up.
/// @throws qwsm::io::WriteError where it cannot be written.
void WriteKitti3(const std::filesystem::path& file, const std::vector<Pose3>& T_map_scan);

/// Reads poses: a TUM trajectory, a folder of results that holds one, or a folder of `.frames` or
/// else `.pose` files of 3DTK.
/// @throws std::runtime_error naming file and line where there are none, or two of one scan.
NumberedPoses ReadPoses(const std::filesystem::path& file_or_folder);

/// Poses that are only counted, 0 to N - 1, by as many numbers in order: they are of the
/// same scans. All others stay as they are.
NumberedPoses Renumbered(const NumberedPoses& poses, const std::vector<double>& numbers);

}  // namespace slam6d::io
