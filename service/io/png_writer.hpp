// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "service/io/canvas.hpp"

namespace qwsm::io {

/// Writes a PNG without filtering its rows: maps and plots have few colours, and a filter makes
/// them larger and takes most of the time.
/// @throws std::runtime_error where there is no memory for it; a failed stream is left to the
/// caller.
void WritePng(std::ostream& stream, const PixelImage& image);

}  // namespace qwsm::io
