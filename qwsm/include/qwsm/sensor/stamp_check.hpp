// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// Finds out whether the stamps of scans and of odometry are of different clocks.
///
/// By how far its ranges moved from beam to beam, each pair of scans tells a turn; odometry should
/// tell the same turn at the same time. If it does so clearly better some time before or after, the
/// stamps differ by that time. Looks at the first scans of one laser only; some microseconds each.
class StampCheck {
 public:
  /// Takes the next scan of any laser, in the order of time.
  void Add(const LaserScan& scan, const std::optional<Pose2>& T_odom_robot);

  /// What has to be added to the stamps of scans, in seconds; nothing while they fit, or while too
  /// little is known.
  std::optional<double> offset_s() const { return offset_s_; }

 private:
  struct Heading {
    double time_s = 0.0;
    double by_odometry_rad = 0.0;            // Not wrapped.
    std::optional<double> turn_by_scan_rad;  // Since the heading before.
  };

  void Judge();
  double ErrorAt(double offset_s) const;
  std::optional<double> OdometryAt(double time_s) const;

  std::optional<LaserScan> last_;
  double last_theta_rad_ = 0.0;
  std::vector<Heading> headings_;
  std::size_t next_look_ = 100;
  std::optional<double> offset_s_;
};

}  // namespace qwsm
