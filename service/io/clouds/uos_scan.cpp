// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/uos_scan.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "service/io/clouds/text_points.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/files/line_reader.hpp"
#include "service/io/files/number_text.hpp"
#include "slam6d/geometry/position.hpp"

namespace slam6d::io {
namespace {

constexpr const char* kTooFar =
    "the position is more than 10000 km from the origin; its source had failed, or its unit is no "
    "centimetre";

constexpr double kMostAngle_deg = 360.0 * 1000.0;
constexpr const char* kTooManyTurns =
    "an angle is more than a thousand turns; its source had failed";

/// Kinds of steps in a .frames file, by which the viewer colours a scan.
constexpr int kStartStep = 1;
constexpr int kMatchedStep = 2;

/// Axes of the left-handed frame (right, up, forward) in ours (forward, left, up): a mirror.
Eigen::Matrix3d OursFromUos() {
  return Eigen::Matrix3d{{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
}

Pose3 PoseFromUos(const Eigen::Matrix3d& R_uos, const Eigen::Vector3d& position_cm) {
  const Eigen::Matrix3d mirror = OursFromUos();
  return {.rotation = mirror * R_uos * mirror.transpose(),
          .translation_m = kMetresPerUosUnit * (mirror * position_cm)};
}

/// The lines of a small file that hold anything, with their numbers.
std::vector<std::pair<std::size_t, std::string>> ReadLines(const std::filesystem::path& file) {
  std::ifstream stream = qwsm::io::OpenForReading(file);
  qwsm::io::LineReader reader{qwsm::io::ByteSource(stream)};
  std::vector<std::pair<std::size_t, std::string>> lines;
  try {
    while (const std::optional<qwsm::io::Line> line = reader.Next()) {
      if (!IsBlank(line->text)) lines.emplace_back(line->number, line->text);
    }
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return lines;
}

[[noreturn]] void Fail(const std::filesystem::path& file, std::size_t line, const char* what) {
  throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + what);
}

void AppendFrame(const Pose3& pose, int kind, std::string& text) {
  const Eigen::Matrix3d mirror = OursFromUos();
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = mirror.transpose() * pose.rotation * mirror;
  matrix.topRightCorner<3, 1>() = mirror.transpose() * pose.translation_m / kMetresPerUosUnit;
  for (int i = 0; i < 16; ++i) {
    qwsm::io::AppendNumber(text, matrix(i % 4, i / 4));
    text += ' ';
  }
  text += std::to_string(kind) + "\n";
}

}  // namespace

ScanPoints ReadUosPoints(const std::filesystem::path& file) {
  const Eigen::Matrix3d ours_from_uos_m = kMetresPerUosUnit * OursFromUos();
  return ReadTextPoints(file, [&](const Eigen::Vector3d& right_up_forward_cm) {
    return Eigen::Vector3d(ours_from_uos_m * right_up_forward_cm);
  });
}

Pose3 ReadUosPose(const std::filesystem::path& file) {
  std::string content;
  for (const auto& [number, line] : ReadLines(file)) content += line + "\n";
  std::string_view text = content;
  const std::optional<Eigen::Vector3d> position_cm = NextTriple(text);
  if (!position_cm) Fail(file, 1, "expected a position 'x y z'");
  if (!IsPosition(Eigen::Vector3d(kMetresPerUosUnit * *position_cm))) Fail(file, 1, kTooFar);
  const std::optional<Eigen::Vector3d> angles_deg = NextTriple(text);
  if (!angles_deg) Fail(file, 2, "expected three angles in degrees");
  if (!(angles_deg->cwiseAbs().maxCoeff() <= kMostAngle_deg)) Fail(file, 2, kTooManyTurns);
  const Eigen::Vector3d angles_rad = *angles_deg * (std::numbers::pi / 180.0);
  const Eigen::Matrix3d R_uos = (Eigen::AngleAxisd(angles_rad.x(), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(angles_rad.y(), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(angles_rad.z(), Eigen::Vector3d::UnitZ()))
                                    .toRotationMatrix();
  return PoseFromUos(R_uos, *position_cm);
}

Pose3 ReadUosFrames(const std::filesystem::path& file) {
  const auto lines = ReadLines(file);
  if (lines.empty()) Fail(file, 1, "the file is empty; expected sixteen numbers and a kind");
  std::string_view text = lines.back().second;
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) {
    const std::optional<double> value = NextNumber(text);
    if (!value) Fail(file, lines.back().first, "expected sixteen numbers and a kind");
    matrix(i % 4, i / 4) = *value;
  }
  const Eigen::Vector3d position_m = kMetresPerUosUnit * matrix.topRightCorner<3, 1>();
  if (!IsPosition(position_m)) Fail(file, lines.back().first, kTooFar);
  return PoseFromUos(NearestRotation(matrix.topLeftCorner<3, 3>()), matrix.topRightCorner<3, 1>());
}

void WriteUosPoints(const std::filesystem::path& file, const PointCloud& cloud) {
  constexpr double kDigits = 1e3;  // Of a centimetre.
  const Eigen::Matrix3d uos_from_ours = OursFromUos().transpose() / kMetresPerUosUnit;
  std::string text;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (const double coordinate_cm : Eigen::Vector3d(uos_from_ours * cloud[i])) {
      qwsm::io::AppendNumber(text, std::round(coordinate_cm * kDigits) / kDigits);
      text += ' ';
    }
    text.back() = '\n';
  }
  qwsm::io::WriteTextFile(file, text);
}

void WriteUosPose(const std::filesystem::path& file, const Pose3& pose) {
  const Eigen::Matrix3d mirror = OursFromUos();
  const Eigen::Vector3d t_cm = mirror.transpose() * pose.translation_m / kMetresPerUosUnit;
  const Eigen::Matrix3d R = mirror.transpose() * pose.rotation * mirror;
  // R = Rx Ry Rz, the middle angle in [-90, 90] degrees.
  const Eigen::Vector3d angles_rad(std::atan2(-R(1, 2), R(2, 2)),
                                   std::asin(std::clamp(R(0, 2), -1.0, 1.0)),
                                   std::atan2(-R(0, 1), R(0, 0)));
  std::string text;
  for (const Eigen::Vector3d& line :
       {t_cm, Eigen::Vector3d(angles_rad * 180.0 / std::numbers::pi)}) {
    for (const double value : line) {
      qwsm::io::AppendNumber(text, value);
      text += ' ';
    }
    text.back() = '\n';
  }
  qwsm::io::WriteTextFile(file, text);
}

void WriteUosFrames(const std::filesystem::path& file, const Pose3& before, const Pose3& after) {
  std::string text;
  AppendFrame(before, kStartStep, text);
  AppendFrame(after, kMatchedStep, text);
  qwsm::io::WriteTextFile(file, text);
}

}  // namespace slam6d::io
