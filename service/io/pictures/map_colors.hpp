// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/io/pictures/canvas.hpp"

/// Colours of maps, which are those of the RoboCup Rescue League.
namespace qwsm::io::map_colors {

inline constexpr Color kUnknownDark = FromBytes(226, 226, 227);
inline constexpr Color kUnknownLight = FromBytes(237, 237, 238);
inline constexpr Color kFree = FromBytes(255, 255, 255);
inline constexpr Color kWall = FromBytes(0, 40, 120);
inline constexpr Color kStart = FromBytes(255, 200, 0);

}  // namespace qwsm::io::map_colors
