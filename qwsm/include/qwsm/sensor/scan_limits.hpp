// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string_view>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// No planar laser reaches farther, and none sits farther out on its robot.
inline constexpr float kLongestRange_m = 1'000.0F;
/// More beams in one scan are a mistake or an attack.
inline constexpr std::size_t kMostBeams = 100'000;

/// No laser looks more finely from beam to beam: a smaller step is a mistake.
inline constexpr float kLeastBearingStep_rad = 1e-6F;

/// The range maximum that a driver states: by an infinite one it means that there is no limit.
float RangeMaximumOf_m(float stated_m);

/// Time from the first beam to the last that a driver states; 0 where no robot's scan takes as
/// long, or its unit is not the second.
std::chrono::nanoseconds StatedSweep(double stated_s);

/// Whether a laser may sit there on its robot.
bool IsMounting(const Pose2& T_robot_laser);

/// Why a scan must not be matched; empty if it may. Single readings may be anything: StateOf()
/// judges them.
std::string_view ObjectionTo(const LaserScan& scan);

}  // namespace qwsm
