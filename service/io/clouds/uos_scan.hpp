// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/io/clouds/scan_points.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d::io {

/// Length of 3DTK's own unit, in metres.
inline constexpr double kMetresPerUosUnit = 0.01;

/// Reads the points of a 3DTK/UOS `scanNNN.3d`: x (right), y (up), z (forward) in centimetres per
/// line, left-handed; further columns are ignored. Here alone, and in the poses below, are its axes
/// and units turned into ours (x forward, y left, z up, metres).
/// @throws std::runtime_error naming the file when it cannot be read.
ScanPoints ReadUosPoints(const std::filesystem::path& file);

/// Reads a 3DTK/UOS `scanNNN.pose`: position in centimetres, then the angles about x, y and z in
/// degrees (R = Rx Ry Rz in the left-handed frame).
/// @throws std::runtime_error naming file and line when it cannot be read or parsed.
Pose3 ReadUosPose(const std::filesystem::path& file);

/// Reads the last pose of a 3DTK `scanNNN.frames`: sixteen numbers per line, a matrix column by
/// column in the left-handed frame and centimetres, then the kind of the step.
/// @throws std::runtime_error naming file and line when it cannot be read or parsed.
Pose3 ReadUosFrames(const std::filesystem::path& file);

/// Writes points as ReadUosPoints() reads them, to a hundredth of a millimetre.
/// @throws qwsm::io::WriteError where it cannot be written; so do the others.
void WriteUosPoints(const std::filesystem::path& file, const PointCloud& cloud);

/// Writes a pose as ReadUosPose() reads it.
void WriteUosPose(const std::filesystem::path& file, const Pose3& pose);

/// Writes a pose as 3DTK's viewer reads it: two lines, as it shows where a scan was and is.
void WriteUosFrames(const std::filesystem::path& file, const Pose3& before, const Pose3& after);

}  // namespace slam6d::io
