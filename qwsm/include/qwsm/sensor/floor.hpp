// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "qwsm/sensor/laser_scan.hpp"
#include "qwsm/sensor/tilt_track.hpp"

namespace qwsm {

/// Leaves out the beams of a planar laser that may have hit the floor, for the robot leaned.
///
/// A beam that points downwards meets level ground where it has sunk by the height of the laser. It
/// is left out (as kInvalid) unless its reading ends clearly above that: by three standard
/// deviations of what is known of tilt and height. Where the tilt itself is not clear the floor is
/// out of reach, and nothing is left out.
/// @param height_m of the laser above the floor while the robot stands level
/// @return how many beams were left out
std::size_t LeaveOutFloor(const Tilt& tilt, double height_m, LaserScan& scan);

}  // namespace qwsm
