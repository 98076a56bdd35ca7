// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// How many points hold a scan in place, in the direction in which the fewest do, if the
/// one surface that holds it best there is left out: in a corridor none but those of its end tell
/// how far along it the robot is.
/// @param points thinned out.
double PointsHoldingWithoutAnySurface(std::span<const ScanPoint> points);

}  // namespace qwsm
