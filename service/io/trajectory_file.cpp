// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectory_file.hpp"

#include <cmath>
#include <string>

#include "service/io/atomic_file.hpp"
#include "service/io/field_reader.hpp"
#include "service/io/file_error.hpp"
#include "service/io/line_reader.hpp"
#include "service/io/number_text.hpp"

namespace qwsm::io {
namespace {

StampedPose2 ParseTumLine(FieldReader& fields) {
  StampedPose2 pose;
  pose.stamp = fields.Stamp();
  pose.T_map_robot.x_m = fields.Number();
  pose.T_map_robot.y_m = fields.Number();
  fields.Number();  // Height.
  const double x = fields.Number();
  const double y = fields.Number();
  const double z = fields.Number();
  const double w = fields.Number();
  fields.ExpectEnd();
  // Any length will do, but that of nothing.
  const double squared_norm = x * x + y * y + z * z + w * w;
  if (!fields.fault() && !(squared_norm > 0.0)) fields.Fail(FieldFault::kNotFinite);
  pose.T_map_robot.theta_rad = std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
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

Trajectory ReadTum(std::istream& stream, std::string_view name) {
  Trajectory trajectory;
  LineReader lines{ByteSource(stream)};
  while (const std::optional<Line> line = lines.Next()) {
    FieldReader fields(line->text);
    if (fields.AtEnd() || line->text.starts_with('#')) continue;
    trajectory.push_back(ParseTumLine(fields));
    if (fields.fault()) {
      ThrowAtLine(name, line->number, *fields.fault(), "a line is 't x y z qx qy qz qw'");
    }
  }
  return trajectory;
}

Trajectory ReadTumFile(const std::filesystem::path& path) {
  std::ifstream file = OpenForReading(path);
  return ReadTum(file, path.string());
}

}  // namespace qwsm::io
