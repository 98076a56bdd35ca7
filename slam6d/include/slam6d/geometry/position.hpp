// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// Farthest a position may be from the origin along an axis, in metres, where northings of UTM end.
/// What is beyond is an error of its source, or an attack. Equals qwsm::kFarthestCoordinate_m.
inline constexpr double kFarthestCoordinate_m = 1e7;

/// Whether all coordinates of a point are numbers within kFarthestCoordinate_m.
inline bool IsPosition(const Eigen::Vector3d& point_m) {
  return (point_m.array().abs() <= kFarthestCoordinate_m).all();
}

/// Whether a pose is finite and its position within kFarthestCoordinate_m.
inline bool IsPosition(const Pose3& pose) {
  return pose.rotation.allFinite() && IsPosition(pose.translation_m);
}

/// Says why a pose must not be believed; empty if it may be.
std::string_view ObjectionTo(const UncertainPose3& pose);

}  // namespace slam6d
