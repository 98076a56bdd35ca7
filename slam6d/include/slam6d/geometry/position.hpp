// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// Nothing is farther from the origin along an axis, in metres: northings of UTM end here. What is
/// beyond is an error of its source, or an attack. The same as qwsm::kFarthestCoordinate_m.
inline constexpr double kFarthestCoordinate_m = 1e7;

/// Whether a point may be there. One with a NaN may not.
inline bool IsPosition(const Eigen::Vector3d& point_m) {
  return (point_m.array().abs() <= kFarthestCoordinate_m).all();
}

/// Whether a robot may be there.
inline bool IsPosition(const Pose3& pose) {
  return pose.rotation.allFinite() && IsPosition(pose.translation_m);
}

/// Why a pose must not be believed; empty if it may.
std::string_view ObjectionTo(const UncertainPose3& pose);

}  // namespace slam6d
