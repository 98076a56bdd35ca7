// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/pipeline/slam6d/scan_series.hpp"

namespace slam6d::pipeline {

/// What became of one scan of a series.
struct RegisteredScan {
  std::string name;
  std::filesystem::path file;
  qwsm::Timestamp stamp{};  ///< Where none is known, its number in seconds.
  Pose3 T_odom_scan;
  PointCloud cloud;  ///< In the scanner's frame, within range.
  SlamStep step;
  double time_s = 0.0;  ///< Of the registration, without reading.
};

/// A series, registered.
struct Registration {
  std::vector<RegisteredScan> scans;
  std::vector<Pose3> T_map_scan;  ///< In the end.
  RefinementResult refinement;
  std::size_t series_size = 0;
  double refinement_time_s = 0.0;
  bool interrupted = false;  ///< There were more scans, or more fits to be done.
};

/// Who watches a registration.
struct RegistrationObserver {
  /// Told how much of the work is done, in [0, 1], and what it is.
  std::function<void(double share, const std::string& what)> show;
  std::function<void(const std::string& problem)> warn;
  std::function<bool()> should_stop;
};

/// The points that the registration would use.
PointCloud WithinRange(const PointCloud& cloud, const SlamOptions& options);

/// Registers all scans of a series and fits them to each other.
Registration RegisterSeries(ScanSeries& series,
                            const options::RegistrationOptions& options,
                            const RegistrationObserver& observer);

}  // namespace slam6d::pipeline
