// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace qwsm::test {

/// Scenario of a robot with one laser that looks ahead and one that looks back, half a period
/// apart.
inline constexpr const char* kTwoLasers =
    "layout: {kind: rubble}\n"
    "robots:\n"
    "  - laser: {mount_x_m: 0.2}\n"
    "    more_lasers:\n"
    "      - {mount_x_m: -0.2, mount_heading_deg: 180, first_scan_s: 0.05}\n";

}  // namespace qwsm::test
