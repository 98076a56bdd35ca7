// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>

namespace qwsm::io {

/// Opaque pixels in memory, row by row from the top: 32 bits each, 0xRRGGBB.
struct PixelRows {
  int width_px = 0;
  int height_px = 0;
  const unsigned char* first = nullptr;
  std::ptrdiff_t stride_bytes = 0;  ///< Distance from a row to the next.
};

/// Writes a PNG. In maps and plots most pixels are as the one above: each row is written as its
/// difference to the row before and of that only how often a byte repeats, which takes a tenth of
/// the time of a search for longer patterns.
/// @throws std::runtime_error where there is no memory for it; a failed stream is left to the
/// caller.
void WritePng(std::ostream& stream, const PixelRows& rows);

/// Writes cells of four kinds as a grey PNG of two bits per pixel: 0 is black, 3 white.
/// @param cells row by row from the top, each 0 to 3. @pre width_px * height_px of them
/// @throws std::runtime_error as WritePng() does.
void WriteCellsPng(std::ostream& stream, int width_px, std::span<const std::uint8_t> cells);

}  // namespace qwsm::io
