// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "service/io/bags/assembly/bag_faults.hpp"
#include "service/io/bags/assembly/bag_survey.hpp"
#include "service/io/bags/assembly/odometry_track.hpp"

namespace qwsm::io {

/// Tells where stamps of a topic fall back, as a simulator's do that begins anew: what is read by
/// stamps mixes two drives then. @param places in the order of the bag.
void DoubtStampsThatFallBack(const std::string& topic,
                             std::span<const MessagePlace> places,
                             BagFaults& faults);

/// Tells of scans that no odometry is near to in time, if these are more than a few.
/// @param scans all of them, in the order of their stamps.
void DoubtScansWithoutOdometry(std::span<const MessagePlace> scans,
                               const OdometryTrack& odometry,
                               BagFaults& faults);

}  // namespace qwsm::io
