// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/registration_page.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "service/pipeline/slam6d/registration_results.hpp"

namespace slam6d::pipeline {
namespace {

using qwsm::pipeline::Base64;
using qwsm::pipeline::Json;

constexpr std::size_t kMostPoints = 150'000;
constexpr double kMostSteps = 32'767.0;  ///< Of a coordinate, in 16 bits, to either side.
/// Points are strays that are so many times as far off as all but this share of them.
constexpr double kStrayTimes = 4.0;
constexpr double kFarShare = 0.002;
constexpr double kLeastExtent_m = 1e-3;

/// Translation, and rotation row by row: twelve numbers.
Json PoseJson(const Pose3& pose) {
  Json json = Json::Array();
  for (const double part : pose.translation_m) json.Add(part);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) json.Add(pose.rotation(row, column));
  }
  return json;
}

/// The largest coordinate of points in the frames of their scans, but for strays, which would make
/// the steps of all coordinates coarse.
double FarthestCoordinate_m(const Registration& registration) {
  std::vector<double> farthest_m;
  for (const RegisteredScan& scan : registration.scans) {
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
      farthest_m.push_back(scan.cloud[i].cwiseAbs().maxCoeff());
    }
  }
  if (farthest_m.empty()) return kLeastExtent_m;
  const auto strays =
      static_cast<std::ptrdiff_t>(kFarShare * static_cast<double>(farthest_m.size()));
  const auto nearly_all = farthest_m.end() - 1 - strays;
  std::ranges::nth_element(farthest_m, nearly_all);
  const double no_stray_m = std::max(kLeastExtent_m, kStrayTimes * *nearly_all);
  double largest_m = kLeastExtent_m;
  for (const double one_m : farthest_m) {
    if (one_m <= no_stray_m) largest_m = std::max(largest_m, one_m);
  }
  return largest_m;
}

void AddCoordinate(std::string& bytes, double steps) {
  const auto whole = static_cast<std::int16_t>(steps);
  const auto bits = static_cast<std::uint16_t>(whole);
  bytes += static_cast<char>(bits & 0xFFU);
  bytes += static_cast<char>(bits >> 8U);
}

/// Points of a scan in its own frame, every so many, without strays: 16 bits per coordinate, little
/// endian.
std::string PointsText(const PointCloud& cloud, double share, double step_m) {
  const auto count = static_cast<std::size_t>(share * static_cast<double>(cloud.size()));
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d point_m = cloud[i * cloud.size() / count];
    const Eigen::Vector3d steps = (point_m / step_m).array().round();
    if (steps.cwiseAbs().maxCoeff() > kMostSteps) continue;
    for (const double coordinate : steps) AddCoordinate(bytes, coordinate);
  }
  return Base64(std::string_view(bytes));
}

Json ScanJson(const RegisteredScan& scan) {
  Json json;
  json["name"] = scan.name;
  json["status"] = Name(scan.step.status);
  json["points"] = scan.cloud.size();
  json["pairs"] = scan.step.match.pairs;
  json["rms_mm"] = 1e3 * scan.step.match.rms_residual_m;
  json["overlap"] = scan.step.overlap;
  json["contradiction"] = scan.step.contradiction;
  json["time_s"] = scan.time_s;
  json["matched"] = scan.step.status == SlamStatus::kMatched;
  json["loops_to"] = Json::Array();
  for (const std::size_t other : scan.step.loops_to) json["loops_to"].Add(other);
  return json;
}

Json ScansJson(const Registration& registration) {
  std::size_t points = 0;
  for (const RegisteredScan& scan : registration.scans) points += scan.cloud.size();
  const double share =
      std::min(1.0, kMostPoints / static_cast<double>(std::max<std::size_t>(points, 1)));
  const double step_m = FarthestCoordinate_m(registration) / kMostSteps;
  Json json;
  json["step_m"] = step_m;
  json["share"] = share;
  json["all"] = Json::Array();
  for (std::size_t i = 0; i < registration.scans.size(); ++i) {
    const RegisteredScan& scan = registration.scans[i];
    Json one = ScanJson(scan);
    one["before"] = PoseJson(scan.T_odom_scan);
    one["after"] = PoseJson(registration.T_map_scan[i]);
    one["cloud"] = PointsText(scan.cloud, share, step_m);
    json["all"].Add(std::move(one));
  }
  return json;
}

}  // namespace

void WriteRegistrationPage(const std::filesystem::path& path,
                           const qwsm::pipeline::RunTitle& title,
                           const Registration& registration) {
  Json data = qwsm::pipeline::ReportData(title);
  data["kind"] = "registration";
  data["metrics"] = MetricsOf(registration);
  data["scans"] = ScansJson(registration);
  qwsm::pipeline::WriteReportPage(path, title, data);
}

}  // namespace slam6d::pipeline
