// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d::io {

/// The points of one file and what was wrong with it.
struct ScanPoints {
  PointCloud cloud;               ///< Points in the scanner's frame, right-handed, in metres.
  std::size_t skipped_lines = 0;  ///< Lines, or points, that hold no three finite numbers.
  std::string first_problem;      ///< The first of them, as "file:line: what is wrong".

  /// Counts one skipped line more, and keeps the first problem.
  void Skip(const std::string& problem);
};

/// Formats of points, told apart by the ending of the name; .gz, .bz2 or .xz may follow it.
enum class PointFormat {
  kUos,    ///< .3d of 3DTK: centimetres, left-handed.
  kXyz,    ///< .xyz, .txt: x y z per line, further columns ignored.
  kPly,    ///< .ply: ASCII or binary little endian.
  kPcd,    ///< .pcd of PCL: ASCII or binary.
  kKitti,  ///< .bin: x y z intensity, 32-bit floats.
};

/// The format a name ends like. @throws std::runtime_error naming the file and the endings known.
PointFormat PointFormatOf(const std::filesystem::path& file);

/// Whether a name ends like one of the formats.
bool IsPointFile(const std::filesystem::path& file);

/// A file's name without folder, format and compression: "scan007" for "in/scan007.3d.gz".
std::string ScanName(const std::filesystem::path& file);

struct PointFileOptions {
  double uos_unit_m = 0.01;  ///< One unit of a .3d or .pose file.
  double unit_m = 1.0;       ///< One unit of any other file.
};

template <class Visitor>
void Describe(Visitor& visit, PointFileOptions& o) {
  visit(
      "uos_unit_m",
      o.uos_unit_m,
      {.help = "one unit of .3d and .pose files; 3DTK's are centimetres", .min = 1e-6, .max = 1e3});
  visit("unit_m", o.unit_m, {.help = "one unit of all other files", .min = 1e-6, .max = 1e3});
}

/// Reads the points of a file. What is no point is skipped and counted; a file that is cut off
/// yields what stands before the end.
/// @throws std::runtime_error naming the file where it cannot be read or is not of its format.
ScanPoints ReadScanPoints(const std::filesystem::path& file, const PointFileOptions& options = {});

}  // namespace slam6d::io
