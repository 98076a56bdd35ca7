// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/io/clouds/scan_points.hpp"

namespace slam6d::io {

/// Reads the points of a PCD file of PCL, `DATA ascii` or `DATA binary`.
/// @throws std::runtime_error naming file and line where it is no such file.
ScanPoints ReadPcd(const std::filesystem::path& file);

}  // namespace slam6d::io
