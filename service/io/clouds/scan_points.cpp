// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/scan_points.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "service/io/clouds/pcd_file.hpp"
#include "service/io/clouds/ply_file.hpp"
#include "service/io/clouds/point_records.hpp"
#include "service/io/clouds/text_points.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "slam6d/geometry/position.hpp"

namespace slam6d::io {
namespace {

constexpr std::array<std::pair<std::string_view, PointFormat>, 6> kEndings{{
    {".3d", PointFormat::kUos},
    {".xyz", PointFormat::kXyz},
    {".txt", PointFormat::kXyz},
    {".ply", PointFormat::kPly},
    {".pcd", PointFormat::kPcd},
    {".bin", PointFormat::kKitti},
}};

std::filesystem::path WithoutCompression(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  const bool compressed = ending == ".gz" || ending == ".bz2" || ending == ".xz";
  return compressed ? file.stem() : file.filename();
}

std::optional<PointFormat> Recognize(const std::filesystem::path& file) {
  const std::string ending = WithoutCompression(file).extension().string();
  const auto found = std::ranges::find(
      kEndings, ending, [](const auto& known) { return std::string(known.first); });
  if (found == kEndings.end()) return std::nullopt;
  return found->second;
}

PointCloud Scaled(const PointCloud& cloud, double factor) {
  const Pose3 scaling{.rotation = factor * Eigen::Matrix3d::Identity(), .translation_m = {0, 0, 0}};
  return scaling * cloud;
}

/// Takes out the points that no scanner can have seen.
void DropAbsurd(const std::filesystem::path& file, ScanPoints& points) {
  PointCloud kept;
  kept.reserve(points.cloud.size());
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    if (IsPosition(points.cloud[i])) {
      kept.push_back(points.cloud[i]);
    } else {
      points.Skip(file.string() + ": point " + std::to_string(i) +
                  " is more than 10000 km away; are the units right?");
    }
  }
  if (kept.size() < points.cloud.size()) points.cloud = std::move(kept);
}

ScanPoints Read(const std::filesystem::path& file, PointFormat format) {
  switch (format) {
    case PointFormat::kUos:
      return ReadUosPoints(file);
    case PointFormat::kXyz:
      return ReadTextPoints(file);
    case PointFormat::kPly:
      return ReadPly(file);
    case PointFormat::kPcd:
      return ReadPcd(file);
    case PointFormat::kKitti:
      return ReadKittiPoints(file);
  }
  return {};
}

}  // namespace

void ScanPoints::Skip(const std::string& problem) {
  if (++skipped_lines == 1) first_problem = problem;
}

PointFormat PointFormatOf(const std::filesystem::path& file) {
  if (const std::optional<PointFormat> format = Recognize(file)) return *format;
  throw std::runtime_error(file.string() +
                           ": not a known file of points; its name must end in .3d, .xyz, .txt, "
                           ".ply, .pcd or .bin, with or without .gz, .bz2, .xz");
}

bool IsPointFile(const std::filesystem::path& file) { return Recognize(file).has_value(); }

std::string ScanName(const std::filesystem::path& file) {
  return WithoutCompression(file).stem().string();
}

ScanPoints ReadScanPoints(const std::filesystem::path& file, const PointFileOptions& options) {
  const PointFormat format = PointFormatOf(file);
  ScanPoints points = Read(file, format);
  const double factor =
      format == PointFormat::kUos ? options.uos_unit_m / kMetresPerUosUnit : options.unit_m;
  if (factor != 1.0) points.cloud = Scaled(points.cloud, factor);
  DropAbsurd(file, points);
  return points;
}

}  // namespace slam6d::io
