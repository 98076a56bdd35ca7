// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/io/clouds/cloud_bag.hpp"
#include "service/io/clouds/trajectory3_file.hpp"
#include "service/options/slam6d/registration_options.hpp"

namespace slam6d::pipeline {

/// Where the points of a scan are: a file, or one of the clouds of a bag.
struct ScanPlace {
  std::filesystem::path file;         ///< Of a cloud of a bag "BAG:NAME", for messages.
  std::string name;                   ///< As LoadedScan has it.
  std::shared_ptr<io::CloudBag> bag;  ///< Null for a file.
  std::size_t number = 0;             ///< Of the cloud among those of the bag.
};

/// The scans that are meant by arguments: files as they are, the clouds of bags in the order of
/// their stamps, folders for what is in them, in the order of their numbers.
/// @param tell is told how bags were understood, and what is wrong with them.
/// @throws std::runtime_error where there are none, or a folder holds several formats.
std::vector<ScanPlace> FindScans(const std::vector<std::filesystem::path>& arguments,
                                 const io::CloudBagOptions& options,
                                 const io::CloudBag::Tell& tell);

/// A scan as it was read.
struct LoadedScan {
  /// Name of the file, without folder and endings; "scanNNN" by its place where names repeat.
  std::string name;
  /// The number at the end of its name, where all names differ in that alone; or else its place in
  /// the series, counted from 0.
  std::size_t number = 0;
  std::filesystem::path file;
  std::optional<qwsm::Timestamp> stamp;  ///< Where its source tells it.
  PointCloud cloud;                      ///< Points; none where the scan was left out.
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
  /// Gives scans in the order of their places.
  /// @param starts poses by the numbers of the scans, or as many that are only counted; empty: from
  ///        `NAME.pose` beside each file, or the odometry of the bag.
  ScanSeries(std::vector<ScanPlace> places,
             io::NumberedPoses starts,
             const options::RegistrationOptions& options);

  std::size_t size() const { return places_.size(); }
  std::optional<LoadedScan> Next();

 private:
  struct ReadScan {
    LoadedScan scan;
    bool is_of_bag = false;
    std::optional<Pose3> T_odom_scan;  ///< As a bag tells it.
    double range_m = 0.0;              ///< Range that half of the points exceed.
  };

  ReadScan Read(std::size_t scan) const;
  static void ReadCloud(const ScanPlace& place, ReadScan& read);
  void ReadFile(const ScanPlace& place, ReadScan& read) const;
  void ReadAhead();
  void CheckRange(ReadScan& read);
  Pose3 StartPose(ReadScan& read);
  std::optional<Pose3> PoseInFile(LoadedScan& scan);

  std::vector<ScanPlace> places_;
  std::vector<std::size_t> numbers_;  ///< Of the scans at the places.
  io::NumberedPoses starts_;
  options::RegistrationOptions options_;
  std::size_t read_ = 0;
  std::deque<ReadScan> ahead_;
  std::vector<double> ranges_m_;  ///< Ranges of the scans in the right units.
  std::vector<Pose3> poses_;      ///< Poses of the scans given out.
  bool told_of_no_pose_ = false;
};

}  // namespace slam6d::pipeline
