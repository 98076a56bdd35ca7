// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d::io {

/// The points of one `.3d` file and what was wrong with it.
struct UosPoints {
  PointCloud cloud;               ///< In the scanner's frame, right-handed, metres.
  std::size_t skipped_lines = 0;  ///< Lines that hold no three finite numbers.
  std::string first_problem;      ///< "file:line: what is wrong", of the first skipped line.
};

/// Reads the points of a 3DTK/UOS `scanNNN.3d`: x (right), y (up), z (forward) in centimetres per
/// line, left-handed; further columns are ignored. The one place where its axes and units are
/// turned into ours (x forward, y left, z up, metres).
/// @throws std::runtime_error naming the file when it cannot be read.
UosPoints ReadUosPoints(const std::filesystem::path& file);

/// Reads a 3DTK/UOS `scanNNN.pose`: position in centimetres, then the angles about x, y and z in
/// degrees (R = Rx Ry Rz in the left-handed frame).
/// @throws std::runtime_error naming file and line when it cannot be read or parsed.
Pose3 ReadUosPose(const std::filesystem::path& file);

/// The numbers NNN of the `scanNNN.3d` in a folder, ascending.
std::vector<std::string> ListUosScans(const std::filesystem::path& folder);

}  // namespace slam6d::io
