// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/pipeline/slam6d/scan_series.hpp"

namespace slam6d::pipeline {

/// The outcome of one scan of a series.
struct RegisteredScan {
  std::string name;
  std::filesystem::path file;
  qwsm::Timestamp stamp{};  ///< Stamp of the scan; where none is known, its number in seconds.
  Pose3 T_odom_scan;
  PointCloud cloud;  ///< Points within range, in the scanner's frame.
  SlamStep step;
  double time_s = 0.0;  ///< Time of the registration, without reading.
};

/// A registered series.
struct Registration {
  std::vector<RegisteredScan> scans;
  std::vector<Pose3> T_map_scan;  ///< Poses in the end.
  RefinementResult refinement;
  std::size_t series_size = 0;
  double refinement_time_s = 0.0;
  bool interrupted = false;  ///< Whether there were more scans, or more fits to be done.
};

/// Watches a registration.
struct RegistrationObserver {
  /// Is told how much of the work is done, in [0, 1], and what it is.
  std::function<void(double share, const std::string& what)> show;
  std::function<void(const std::string& problem)> warn;
  std::function<bool()> should_stop;
};

/// The points of a cloud that the registration would use.
PointCloud WithinRange(const PointCloud& cloud, const SlamOptions& options);

/// Registers all scans of a series and fits them to each other.
Registration RegisterSeries(ScanSeries& series,
                            const options::RegistrationOptions& options,
                            const RegistrationObserver& observer);

}  // namespace slam6d::pipeline
