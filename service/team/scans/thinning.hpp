// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::team {

/// Keeps every n-th beam, or point, of a scan, with the least n by which no more than `most` are
/// left.
/// @return n: 1 where nothing was left out.
/// @pre most > 0
std::size_t Thin(LaserScan& scan, std::size_t most);
std::size_t Thin(CloudScan& scan, std::size_t most);

}  // namespace qwsm::team
