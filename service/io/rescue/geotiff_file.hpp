// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "service/io/rescue/rescue_map.hpp"

namespace qwsm::io {

/// Writes a picture as a GeoTIFF (OGC 19-008r4), LZW-compressed, in a frame of its own whose unit
/// is the metre: pixel scale, the upper left corner as tie point, pixels are areas.
/// @throws WriteError.
void WriteGeoTiff(const std::filesystem::path& path, const GeoPicture& picture);

/// Writes the world file of a picture: metres per pixel, two rotations, which are zero, minus
/// metres per pixel, x and y of the middle of the first pixel; a line each. @throws WriteError.
void WriteWorldFile(const std::filesystem::path& path, const GeoPicture& picture);

}  // namespace qwsm::io
