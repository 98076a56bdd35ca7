// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <unordered_set>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Remembers where surfaces were seen. Who looks at a wall again and again learns no more of where
/// he is than at first.
class SeenSurfaces {
 public:
  /// The share of points that lie where nothing was seen before; from now on it was.
  double TakeNews(std::span<const ScanPoint> points, const Pose2& T_local_robot);

 private:
  std::unordered_set<std::uint64_t> cells_;
};

}  // namespace qwsm
