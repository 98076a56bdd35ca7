// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/scan_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

#include "service/io/clouds/uos_scan.hpp"
#include "service/io/files/numbered_name.hpp"

namespace slam6d::pipeline {
namespace {

namespace fs = std::filesystem;

using qwsm::io::NumberedName;

/// Scans read before the first is given out, so that one in other units is told from the others.
constexpr std::size_t kReadAhead = 3;

/// Names in the order of the numbers at their ends.
bool ByNumber(const fs::path& a, const fs::path& b) {
  return NumberedName::Of(io::ScanName(a)).Order() < NumberedName::Of(io::ScanName(b)).Order();
}

/// Every scan leaves files under its name: where two have the same, all are called by their place.
void MakeNamesUnique(std::vector<ScanPlace>& places) {
  std::set<std::string> names;
  for (const ScanPlace& place : places) names.insert(place.name);
  if (names.size() == places.size()) return;
  for (std::size_t i = 0; i < places.size(); ++i) places[i].name = fmt::format("scan{:03}", i);
}

/// Numbers longer than these are no seconds of a stamp.
constexpr std::size_t kMostDigits = 9;

/// The numbers at the ends of the names, if these differ in nothing else; or else the places.
std::vector<std::size_t> NumbersOf(const std::vector<ScanPlace>& places) {
  std::vector<std::size_t> counted(places.size());
  std::iota(counted.begin(), counted.end(), std::size_t{0});
  std::vector<std::size_t> numbers;
  std::set<std::string> names;
  for (const ScanPlace& place : places) {
    const NumberedName split = NumberedName::Of(place.name);
    names.insert(split.name);
    const std::optional<std::uint64_t> number = split.Number();
    if (!number || split.digits.size() > kMostDigits || names.size() > 1) return counted;
    numbers.push_back(*number);
  }
  const bool all_differ = std::set(numbers.begin(), numbers.end()).size() == numbers.size();
  return all_differ ? numbers : counted;
}

/// @param files of a folder, in the order of their names.
void RefuseTheSameScanTwice(const fs::path& folder, const std::vector<fs::path>& files) {
  const auto twice = std::ranges::adjacent_find(files, {}, io::ScanName);
  if (twice == files.end()) return;
  throw std::runtime_error(
      fmt::format("{}: holds the same scan twice, {} and {}; name the files "
                  "that are meant, or remove one of the two",
                  folder.string(),
                  twice->filename().string(),
                  std::next(twice)->filename().string()));
}

std::vector<fs::path> FindInFolder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::set<io::PointFormat> formats;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    // Texts in a folder are rather notes than points; as arguments they are believed.
    const bool is_text = entry.path().filename().string().find(".txt") != std::string::npos;
    if (!entry.is_regular_file() || is_text || !io::IsPointFile(entry.path())) continue;
    files.push_back(entry.path());
    formats.insert(io::PointFormatOf(entry.path()));
  }
  if (formats.contains(io::PointFormat::kUos)) {  // Others beside them are results or sources.
    std::erase_if(files, [](const fs::path& file) {
      return io::PointFormatOf(file) != io::PointFormat::kUos;
    });
  } else if (formats.size() > 1) {
    throw std::runtime_error(folder.string() +
                             ": holds points in several formats; name the files that are meant");
  }
  if (files.empty()) {
    throw std::runtime_error(folder.string() +
                             ": holds no scans (.3d, .xyz, .ply, .pcd, .bin, packed or not)");
  }
  std::ranges::sort(files);  // What directories list in any order.
  std::ranges::stable_sort(files, ByNumber);
  RefuseTheSameScanTwice(folder, files);
  return files;
}

void AddClouds(const fs::path& path,
               const std::shared_ptr<io::CloudBag>& bag,
               std::vector<ScanPlace>& places) {
  for (std::size_t i = 0; i < bag->size(); ++i) {
    const std::string name = fmt::format("scan{:03}", places.size());
    places.push_back({.file = path.string() + ":" + name, .name = name, .bag = bag, .number = i});
  }
}

double MedianRangeM(const PointCloud& cloud) {
  if (cloud.empty()) return 0.0;
  std::vector<double> ranges_m;
  for (std::size_t i = 0; i < cloud.size(); ++i) ranges_m.push_back(cloud[i].norm());
  const auto middle = ranges_m.begin() + static_cast<std::ptrdiff_t>(ranges_m.size() / 2);
  std::ranges::nth_element(ranges_m, middle);
  return *middle;
}

/// The lower of the two in the middle: of two scans, the narrower is believed.
double LowerMedian(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::vector<ScanPlace> FindScans(const std::vector<fs::path>& arguments,
                                 const io::CloudBagOptions& options,
                                 const io::CloudBag::Tell& tell) {
  std::vector<ScanPlace> places;
  const auto add_file = [&](const fs::path& file) {
    places.push_back({.file = file, .name = io::ScanName(file), .bag = nullptr});
  };
  for (const fs::path& argument : arguments) {
    if (qwsm::io::IsBag(argument)) {
      AddClouds(argument, std::make_shared<io::CloudBag>(argument, options, tell), places);
    } else if (fs::is_directory(argument)) {
      for (const fs::path& file : FindInFolder(argument)) add_file(file);
    } else {
      if (!fs::exists(argument)) {
        throw std::runtime_error(argument.string() + ": no such file or folder");
      }
      static_cast<void>(io::PointFormatOf(argument));
      add_file(argument);
    }
  }
  MakeNamesUnique(places);
  return places;
}

ScanSeries::ScanSeries(std::vector<ScanPlace> places,
                       io::NumberedPoses starts,
                       const options::RegistrationOptions& options)
    : places_(std::move(places)),
      numbers_(NumbersOf(places_)),
      starts_(io::Renumbered(starts, {numbers_.begin(), numbers_.end()})),
      options_(options) {}

std::optional<LoadedScan> ScanSeries::Next() {
  ReadAhead();
  if (ahead_.empty()) return std::nullopt;
  ReadScan read = std::move(ahead_.front());
  ahead_.pop_front();
  CheckRange(read);
  read.scan.T_odom_scan = StartPose(read);
  // As a network carries it: there and here the same scans give the same poses.
  Eigen::Matrix3d& R = read.scan.T_odom_scan.rotation;
  R = RotationFromQuaternion(QuaternionOf(R));
  poses_.push_back(read.scan.T_odom_scan);
  return std::move(read.scan);
}

void ScanSeries::ReadAhead() {
  while (read_ < places_.size() && ahead_.size() < kReadAhead) {
    ahead_.push_back(Read(read_++));
    const double range_m = ahead_.back().range_m;
    if (range_m > 0.0 && ranges_m_.size() < kReadAhead) ranges_m_.push_back(range_m);
  }
}

ScanSeries::ReadScan ScanSeries::Read(std::size_t scan) const {
  const ScanPlace& place = places_[scan];
  ReadScan read;
  read.scan.number = numbers_[scan];
  read.scan.name = place.name;
  read.scan.file = place.file;
  try {
    place.bag ? ReadCloud(place, read) : ReadFile(place, read);
    if (read.scan.cloud.empty()) {
      read.scan.problems.push_back(place.file.string() + ": holds no points");
    }
    read.range_m = MedianRangeM(read.scan.cloud);
  } catch (const std::runtime_error& error) {
    read.scan.problems.emplace_back(error.what());
  }
  return read;
}

void ScanSeries::ReadCloud(const ScanPlace& place, ReadScan& read) {
  read.is_of_bag = true;
  io::CloudBag::Cloud cloud = place.bag->Read(place.number);
  read.scan.stamp = cloud.stamp;
  read.scan.cloud = std::move(cloud.points);
  read.T_odom_scan = cloud.T_odom_sensor;
}

void ScanSeries::ReadFile(const ScanPlace& place, ReadScan& read) const {
  io::ScanPoints points = io::ReadScanPoints(place.file, options_.files);
  if (points.skipped_lines > 0) {
    read.scan.problems.push_back(fmt::format(
        "{} ({} of this kind; the rest is used)", points.first_problem, points.skipped_lines));
  }
  read.scan.cloud = std::move(points.cloud);
}

void ScanSeries::CheckRange(ReadScan& read) {
  if (read.range_m <= 0.0 || ranges_m_.empty()) return;
  const double usual_m = LowerMedian(ranges_m_);
  const double ratio = read.range_m / usual_m;
  if (ratio <= options_.max_range_ratio && 1.0 / ratio <= options_.max_range_ratio) return;
  read.scan.problems.push_back(
      fmt::format("{}: half of its points are farther off than {:.4g} m, where other scans have "
                  "{:.4g} m: it is in other units and left out; see files.unit_m, files.uos_unit_m "
                  "and max_range_ratio",
                  read.scan.file.string(),
                  read.range_m,
                  usual_m));
  read.scan.cloud = PointCloud{};
}

/// Where no pose is known, the last motion is taken to go on.
Pose3 ScanSeries::StartPose(ReadScan& read) {
  const std::size_t known = poses_.size();
  Pose3 guess;
  if (known > 0) guess = poses_.back();
  if (known > 1) guess = poses_.back() * (poses_[known - 2].Inverse() * poses_.back());
  if (starts_.empty()) {
    return (read.is_of_bag ? read.T_odom_scan : PoseInFile(read.scan)).value_or(guess);
  }
  const auto number = static_cast<double>(read.scan.number);
  if (const auto start = starts_.find(number); start != starts_.end()) return start->second;
  read.scan.problems.push_back(
      fmt::format("{}: no pose with the number {} to start from", read.scan.file.string(), number));
  return guess;
}

/// The pose in the file beside that of the points.
std::optional<Pose3> ScanSeries::PoseInFile(LoadedScan& scan) {
  const fs::path file = scan.file.parent_path() / (io::ScanName(scan.file) + ".pose");
  try {
    if (fs::exists(file)) return io::ReadUosPose(file);
    if (!told_of_no_pose_) {
      scan.problems.push_back(file.string() +
                              ": is missing; such scans start where the motion "
                              "before them leads");
    }
    told_of_no_pose_ = true;
  } catch (const std::runtime_error& error) {
    scan.problems.push_back(std::string(error.what()) +
                            "; the scan starts where the motion before it leads");
  }
  return std::nullopt;
}

}  // namespace slam6d::pipeline
