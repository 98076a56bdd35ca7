// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectories/trajectory_file.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/field_reader.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/files/number_text.hpp"
#include "service/io/files/table_file.hpp"

namespace qwsm::io {
namespace {

/// The yaw of a quaternion of any length but none.
std::optional<double> YawOf(const Eigen::Quaterniond& any_length) {
  const double largest = any_length.coeffs().cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return std::nullopt;
  const Eigen::Quaterniond q(any_length.coeffs() / largest);  // Its squares can be summed.
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    q.w() * q.w() + q.x() * q.x() - q.y() * q.y() - q.z() * q.z());
}

StampedPose2 ReadPose(FieldReader& fields) {
  StampedPose2 pose;
  pose.stamp = fields.Stamp();
  pose.T_map_robot.x_m = fields.Coordinate();
  pose.T_map_robot.y_m = fields.Coordinate();
  fields.Number();  // Height.
  Eigen::Quaterniond attitude;
  for (double* const part : {&attitude.x(), &attitude.y(), &attitude.z(), &attitude.w()}) {
    *part = fields.Number();
  }
  const std::optional<double> yaw_rad = YawOf(attitude);
  if (!yaw_rad) fields.Fail(FieldFault::kNoRotation);
  pose.T_map_robot.theta_rad = yaw_rad.value_or(0.0);
  return pose;
}

}  // namespace

void WriteTumLine(std::ostream& stream, const StampedPose2& pose) {
  const Pose2& T_map_robot = pose.T_map_robot;
  std::string line;
  AppendStamp(line, pose.stamp);
  const double half_rad = 0.5 * T_map_robot.theta_rad;
  for (const double value :
       {T_map_robot.x_m, T_map_robot.y_m, 0.0, 0.0, 0.0, std::sin(half_rad), std::cos(half_rad)}) {
    line += ' ';
    AppendNumber(line, value);
  }
  line += '\n';
  stream << line;
}

void WriteTumFile(const std::filesystem::path& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  for (const StampedPose2& pose : trajectory) WriteTumLine(file.stream(), pose);
  file.Commit();
}

void WriteKittiFile(const std::filesystem::path& path, const Trajectory& trajectory) {
  AtomicFile file(path);
  for (const StampedPose2& pose : trajectory) {
    const Pose2& T = pose.T_map_robot;
    const double c = std::cos(T.theta_rad);
    const double s = std::sin(T.theta_rad);
    std::string line;
    for (const double value : {c, 0.0 - s, 0.0, T.x_m, s, c, 0.0, T.y_m, 0.0, 0.0, 1.0, 0.0}) {
      if (!line.empty()) line += ' ';
      AppendNumber(line, value);
    }
    file.stream() << line << '\n';
  }
  file.Commit();
}

Trajectory ReadTum(std::istream& stream, std::string_view name) {
  Trajectory trajectory;
  ReadTable(stream, name, "a line is 't x y z qx qy qz qw'", [&](FieldReader& fields) {
    trajectory.push_back(ReadPose(fields));
  });
  return trajectory;
}

Trajectory ReadTumFile(const std::filesystem::path& path) {
  std::ifstream file = OpenForReading(path);
  return ReadTum(file, path.string());
}

}  // namespace qwsm::io
