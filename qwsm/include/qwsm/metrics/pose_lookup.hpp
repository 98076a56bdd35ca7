// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm {

/// Sorts poses by rising stamps; equal stamps keep their order.
Trajectory SortedByStamp(Trajectory trajectory);

/// Finds the index of the pose nearest in time, the earlier of two at equal distance; none if it is
/// further away than `tolerance`. O(log n).
/// @pre `sorted` has rising stamps.
std::optional<std::size_t> NearestIndex(const Trajectory& sorted,
                                        Timestamp stamp,
                                        std::chrono::nanoseconds tolerance);

/// Interpolates the pose at `stamp`, on the straight line between the poses before and after it;
/// before the first and after the last pose theirs, as far as `tolerance`. O(log n).
/// @pre `sorted` has rising stamps.
std::optional<Pose2> InterpolatedPose(const Trajectory& sorted,
                                      Timestamp stamp,
                                      std::chrono::nanoseconds tolerance);

}  // namespace qwsm
