// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace qwsm {

/// Lasers are told apart by where they sit on the robot. More places than these are those of one
/// that is mounted anew again and again.
inline constexpr std::size_t kMostMountings = 16;

}  // namespace qwsm
