// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace qwsm::io {

/// A grey picture, row by row from the top: 0 is black, 255 white.
struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;
};

/// Writes a binary PGM (P5). @throws WriteError.
void WritePgm(const std::filesystem::path& path, const GreyImage& image);

/// Reads a binary PGM of 8 bits. @throws std::runtime_error naming the file where it is none.
GreyImage ReadPgm(const std::filesystem::path& path);

}  // namespace qwsm::io
