// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sim {

inline constexpr double kGravity_mps2 = 9.81;

}  // namespace sim
