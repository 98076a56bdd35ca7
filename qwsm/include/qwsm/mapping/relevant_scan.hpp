// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/search/point_quadtree.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// A scan that the map was extended with, and where it was taken.
struct RelevantScan {
  ScanId id = 0;
  LaserScan scan;
  UncertainPose2 map_robot;
};

}  // namespace qwsm
