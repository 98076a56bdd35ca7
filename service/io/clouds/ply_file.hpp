// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/io/clouds/scan_points.hpp"

namespace slam6d::io {

/// Reads the vertices of a PLY file, ASCII or binary little endian; other elements behind them are
/// ignored.
/// @throws std::runtime_error naming file and line where it is no such file.
ScanPoints ReadPly(const std::filesystem::path& file);

/// Writes points as a binary PLY, in metres: as 32-bit floats, or as doubles where floats would
/// round to more than a millimetre.
/// @throws qwsm::io::WriteError where it cannot be written.
void WritePly(const std::filesystem::path& file, const PointCloud& cloud);

}  // namespace slam6d::io
