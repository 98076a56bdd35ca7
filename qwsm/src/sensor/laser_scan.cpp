// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/laser_scan.hpp"

#include <cmath>

namespace qwsm {

BeamState StateOf(float range_m, const LaserGeometry& geometry) {
  if (std::isnan(range_m)) return BeamState::kInvalid;
  if (range_m <= 0.0F || range_m < geometry.range_min_m) return BeamState::kTooNear;
  if (range_m >= kMissShareOfMaximum * geometry.range_max_m) return BeamState::kMiss;
  return BeamState::kHit;
}

}  // namespace qwsm
