// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/tracked_scan.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace qwsm {
namespace {

// Whether two scans tell of the same points. Readings that failed are no numbers, which are equal
// to nothing.
bool HaveSamePoints(const LaserScan& a, const LaserScan& b) {
  const auto bits = [](float range_m) { return std::bit_cast<std::uint32_t>(range_m); };
  return a.geometry == b.geometry && std::ranges::equal(a.ranges_m, b.ranges_m, {}, bits, bits);
}

}  // namespace

std::vector<ScanPoint> TrackedScan::RelevantPoints() const {
  return HaveSamePoints(step.relevant_scan, scan) ? points : ToPoints(step.relevant_scan);
}

}  // namespace qwsm
