// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm::io {

/// Carries the poses of a trajectory by the log's odometry to every reading between them and behind
/// the last one (see CarryByOdometry), as the relations of a benchmark often name moments between
/// scans. The result is not sorted by time.
///
/// @param log at its beginning; it is read to its end
/// @param trajectory poses at scans of the log, in its order, stamps equal to 0.1 ms; scans without
/// a pose count as odometry
/// @throws std::runtime_error where a pose belongs to no scan of the log
Trajectory CarryToOdometry(LogReader& log, const Trajectory& trajectory);

}  // namespace qwsm::io
