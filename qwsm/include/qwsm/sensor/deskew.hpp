// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// The scan as it would be, had the robot stood still where it was at the first beam.
///
/// Beams are measured one after the other while the robot moves evenly, along a circle. Its turn
/// changes the angle between beams and nothing else; by how far it went, readings change and move
/// to other beams. Beams that nothing moves to become kInvalid. A robot that stood gives the scan
/// itself, and so does a motion that is none of a robot: faster than 20 m/s, or turning back half
/// as fast as its laser's mirror turns on. O(beams).
/// @param T_first_last pose of the robot at the last beam, as seen from that at the first
/// @return the scan, whose sweep is now its `deskewed_sweep`
LaserScan Deskewed(const LaserScan& scan, const Pose2& T_first_last);

}  // namespace qwsm
