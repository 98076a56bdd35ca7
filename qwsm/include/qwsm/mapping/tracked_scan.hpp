// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// A scan as if the robot had stood while it was taken, and where it was found to be taken.
struct TrackedScan {
  MappingStep step;
  LaserScan scan;
  std::vector<ScanPoint> points;  ///< Of the scan.

  /// Points of the scan that the map is to be extended with. Mostly nothing moved, and they are
  /// those of this scan. @pre step.relevant
  std::vector<ScanPoint> RelevantPoints() const;
};

}  // namespace qwsm
