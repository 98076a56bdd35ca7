// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm::team {

/// Finds where a map looks as it does around some of its scans, elsewhere: the next leg of a
/// zigzag, the next room of many. That is what tells how much alike places of a building are.
/// @return where the frame of the scans lies in the map there, as motions of the map onto itself;
/// those that most scans agree on, the first one first. Once it is stopped, those found so far.
std::vector<Pose2> FindEchoes(std::span<const RelevantScan* const> scans,
                              const ScanMap& map,
                              const std::stop_token& stop = {});

/// Finds where another map looks as one does around some of its scans.
/// @return where the frame of the scans lies in the other map, in the same order; likewise.
std::vector<Pose2> FindLikenesses(std::span<const RelevantScan* const> scans,
                                  const ScanMap& other,
                                  const std::stop_token& stop = {});

}  // namespace qwsm::team
