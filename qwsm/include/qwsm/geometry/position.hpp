// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Nothing is farther from the origin along an axis, in metres: northings of UTM end here, and a
/// map can still tell its cells apart. What is beyond is an error of its source, or an attack.
inline constexpr double kFarthestCoordinate_m = 1e7;

/// Whether a number may be a coordinate of a robot, or of what it sees. NaN may not.
inline bool IsCoordinate(double coordinate_m) {
  return std::abs(coordinate_m) <= kFarthestCoordinate_m;
}

/// Whether a robot may be there: the heading is finite, the coordinates are such.
bool IsPosition(const Pose2& pose);

/// Why a pose must not be believed; empty if it may.
std::string_view ObjectionTo(const UncertainPose2& pose);

}  // namespace qwsm
