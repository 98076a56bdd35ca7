// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/registration_results.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "service/io/clouds/ply_file.hpp"
#include "service/io/clouds/trajectory3_file.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/pictures/cloud_picture.hpp"
#include "service/pipeline/results/result_file.hpp"
#include "service/pipeline/slam6d/registration_page.hpp"

namespace slam6d::pipeline {
namespace {

using qwsm::pipeline::ResultFile;

/// The scans as odometry puts them, the first where the map has it.
std::vector<Pose3> PosesBefore(const Registration& registration) {
  std::vector<Pose3> poses;
  for (const RegisteredScan& scan : registration.scans) poses.push_back(scan.T_odom_scan);
  return poses;
}

PointCloud Merge(const Registration& registration, const std::vector<Pose3>& poses) {
  std::size_t points = 0;
  for (const RegisteredScan& scan : registration.scans) points += scan.cloud.size();
  PointCloud merged;
  merged.reserve(points);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    merged.Append(poses[i] * registration.scans[i].cloud);
  }
  return merged;
}

std::vector<Eigen::Vector3d> PathOf(const std::vector<Pose3>& poses) {
  std::vector<Eigen::Vector3d> path_m;
  for (const Pose3& pose : poses) path_m.push_back(pose.translation_m);
  return path_m;
}

/// Before and after in the same window, so that one can be laid over the other.
void DrawViews(const io::CloudScene& before,
               const io::CloudScene& after,
               const qwsm::pipeline::ResultsFolder& folder) {
  const io::CloudWindow top = io::WindowOf(after, io::CloudView::kTop);
  const io::CloudWindow side = io::WindowOf(after, io::CloudView::kSide);
  io::WriteCloudPicture(folder / ResultFile::kTopBefore, before, io::CloudView::kTop, top);
  io::WriteCloudPicture(folder / ResultFile::kTopAfter, after, io::CloudView::kTop, top);
  io::WriteCloudPicture(folder / ResultFile::kSideBefore, before, io::CloudView::kSide, side);
  io::WriteCloudPicture(folder / ResultFile::kSideAfter, after, io::CloudView::kSide, side);
}

std::string LoopsText(const std::vector<std::size_t>& loops) {
  return fmt::format("{}", fmt::join(loops, " "));
}

/// A field of a table with commas (RFC 4180): scans are called as their files are.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The names of the upper triangle of a covariance, row by row, with their units.
std::string CovarianceHeader() {
  constexpr std::array<const char*, 6> kNames{"x", "y", "z", "roll", "pitch", "yaw"};
  std::string text;
  for (std::size_t row = 0; row < kNames.size(); ++row) {
    for (std::size_t column = row; column < kNames.size(); ++column) {
      const char* const unit = column < 3 ? "m2" : row < 3 ? "m_rad" : "rad2";
      text += fmt::format(",cov_{}{}_{}", kNames[row], kNames[column], unit);
    }
  }
  return text;
}

std::string CovarianceText(const Matrix6d& covariance) {
  std::string text;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      text += fmt::format(",{:.6g}", covariance(row, column));
    }
  }
  return text;
}

std::string Table(const Registration& registration) {
  std::string text =
      "scan,name,status,points,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg,iterations,pairs,"
      "rms_residual_m,overlap,contradiction,loops_to,time_s,open_motions" +
      CovarianceHeader() + "\n";
  for (std::size_t i = 0; i < registration.scans.size(); ++i) {
    const RegisteredScan& scan = registration.scans[i];
    const Pose3& pose = registration.T_map_scan[i];
    const Eigen::Vector3d angles_deg = RollPitchYaw(pose.rotation) * 180.0 / std::numbers::pi;
    text += fmt::format(
        "{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{:.6f},{:.3f},{:.4f},{},{:.4f}"
        ",{}{}\n",
        i,
        Quoted(scan.name),
        Name(scan.step.status),
        scan.step.points,
        pose.translation_m.x(),
        pose.translation_m.y(),
        pose.translation_m.z(),
        angles_deg.x(),
        angles_deg.y(),
        angles_deg.z(),
        scan.step.match.iterations,
        scan.step.match.pairs,
        scan.step.match.rms_residual_m,
        scan.step.overlap,
        scan.step.contradiction,
        LoopsText(scan.step.loops_to),
        scan.time_s,
        scan.step.open_motions,
        CovarianceText(scan.step.covariance));
  }
  return text;
}

}  // namespace

void WriteResults(const Registration& registration,
                  const options::RegistrationOptions& options,
                  const qwsm::pipeline::ResultsFolder& folder,
                  const RegistrationPictures& pictures) {
  const std::vector<Pose3> before = PosesBefore(registration);
  const std::vector<Pose3>& after = registration.T_map_scan;
  std::vector<qwsm::Timestamp> stamps;
  for (const RegisteredScan& scan : registration.scans) stamps.push_back(scan.stamp);
  io::WriteTum3(folder / ResultFile::kTrajectory, after, stamps);
  io::WriteKitti3(folder / ResultFile::kTrajectoryKitti, after);
  for (std::size_t i = 0; i < after.size(); ++i) {
    io::WriteUosFrames(folder / (registration.scans[i].name + ".frames"), before[i], after[i]);
  }
  qwsm::io::WriteTextFile(folder / ResultFile::kScans, Table(registration));
  qwsm::io::WriteTextFile(folder / ResultFile::kMetrics, MetricsOf(registration).Text());
  const PointCloud merged = Merge(registration, after);
  io::WritePly(folder / ResultFile::kModel, Reduce(merged, options.model));
  if (!pictures.drawn) return;
  DrawViews({Merge(registration, before), PathOf(before), "before: as odometry has it"},
            {merged, PathOf(after), "after registration"},
            folder);
  if (!pictures.title) return;
  WriteRegistrationPage(folder / ResultFile::kReport, *pictures.title, registration);
}

}  // namespace slam6d::pipeline
