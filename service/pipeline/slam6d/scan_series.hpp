// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/io/clouds/trajectory3_file.hpp"
#include "service/options/slam6d/registration_options.hpp"

namespace slam6d::pipeline {

/// The files of points that are meant by arguments: files as they are, folders for what is in them,
/// in the order of their numbers.
/// @throws std::runtime_error where there are none, or a folder holds several formats.
std::vector<std::filesystem::path> FindScans(const std::vector<std::filesystem::path>& arguments);

/// A scan as it was read.
struct LoadedScan {
  std::string name;  ///< Name of the file, without folder and endings.
  std::filesystem::path file;
  PointCloud cloud;  ///< Points; none where the scan was left out.
  Pose3 T_odom_scan;
  /// Problems, each naming file and line; the scan is used all the same.
  std::vector<std::string> problems;
};

/// Scans and the poses to start from, one after the other.
///
/// What cannot be read becomes a problem of its scan, not an end of the series: points that are
/// none, a missing pose (the motion before it is taken to go on), a file in other units.
class ScanSeries {
 public:
  /// Gives scans in the order of their files.
  /// @param starts poses by the numbers of the scans, counted from 0; empty: from `NAME.pose`
  ///        beside each file.
  ScanSeries(std::vector<std::filesystem::path> files,
             io::NumberedPoses starts,
             const options::RegistrationOptions& options);

  std::size_t size() const { return files_.size(); }
  std::optional<LoadedScan> Next();

 private:
  struct ReadScan {
    LoadedScan scan;
    double range_m;  ///< Range that half of the points exceed.
  };

  ReadScan Read(const std::filesystem::path& file) const;
  void ReadAhead();
  void CheckRange(ReadScan& read);
  Pose3 StartPose(LoadedScan& scan);

  std::vector<std::filesystem::path> files_;
  io::NumberedPoses starts_;
  options::RegistrationOptions options_;
  std::size_t read_ = 0;
  std::size_t given_ = 0;
  std::deque<ReadScan> ahead_;
  std::vector<double> ranges_m_;  ///< Ranges of the scans in the right units.
  std::vector<Pose3> poses_;      ///< Poses of the scans given out.
  bool told_of_no_pose_ = false;
};

}  // namespace slam6d::pipeline
