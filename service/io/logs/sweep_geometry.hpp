// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// Readings nearer than this lie inside the housing of every scanner; small numbers there are error
/// codes (Hokuyo's URG writes them as 0 - 19 mm).
inline constexpr float kNearestReading_m = 0.02F;

/// The bearings of a sweep whose line states only how many readings it has, as CARMEN guesses them
/// (carmen_laser_guess_fov, carmen_laser_guess_angle_increment): 180 degrees, for 180 and 360
/// readings without the last beam; the counts of scanners with other fields of view by their data
/// sheets; or the given field of view.
LaserGeometry GuessGeometry(std::size_t readings, std::optional<double> field_of_view_rad);

/// The angle between beams where a line states the first and last bearing and the resolution:
/// rounding has blurred each, and some writers count one beam more than there is.
/// @return nothing where the three make no sweep.
std::optional<double> BearingStep(double span_rad, double stated_step_rad, std::size_t readings);

/// Turns the bearings of a laser that is upside down, or counts its beams from the other side.
void Mirror(LaserGeometry& geometry);

/// The range maximum that a line states; 0 where it states none, or what no laser has.
float StatedRangeMaximum(double range_max_m);

}  // namespace qwsm::io
