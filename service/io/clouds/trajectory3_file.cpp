// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/trajectory3_file.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

#include "service/io/clouds/uos_scan.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/files/number_text.hpp"
#include "service/io/files/numbered_name.hpp"
#include "service/io/files/table_file.hpp"

namespace slam6d::io {
namespace {

namespace fs = std::filesystem;

NumberedPoses ReadTum3(const fs::path& file) {
  NumberedPoses poses;
  std::ifstream stream = qwsm::io::OpenForReading(file);
  qwsm::io::ReadTable(
      stream, file.string(), "a line is 't x y z qx qy qz qw'", [&](qwsm::io::FieldReader& fields) {
        const double stamp = fields.Number();
        Pose3 pose;
        for (int axis = 0; axis < 3; ++axis) pose.translation_m(axis) = fields.Coordinate();
        Eigen::Quaterniond q;
        for (double* const part : {&q.x(), &q.y(), &q.z(), &q.w()}) *part = fields.Number();
        if (!(q.norm() > 0.0)) fields.Fail(qwsm::io::FieldFault::kNoRotation);
        pose.rotation = q.normalized().toRotationMatrix();
        if (!poses.emplace(stamp, pose).second) fields.Fail(qwsm::io::FieldFault::kRepeated);
      });
  if (poses.empty()) throw std::runtime_error(file.string() + ": holds no poses");
  return poses;
}

NumberedPoses ReadFolder(const fs::path& folder, const std::string& ending) {
  NumberedPoses poses;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ending) continue;
    const auto number = qwsm::io::NumberedName::Of(entry.path().stem().string()).Number();
    if (!number) continue;
    const Pose3 pose =
        ending == ".frames" ? ReadUosFrames(entry.path()) : ReadUosPose(entry.path());
    if (!poses.emplace(static_cast<double>(*number), pose).second) {
      throw std::runtime_error(
          fmt::format("{}: another file has the number {}, too; leave the one that is meant",
                      entry.path().string(),
                      *number));
    }
  }
  return poses;
}

}  // namespace

void WriteTum3(const fs::path& file,
               const std::vector<Pose3>& T_map_scan,
               const std::vector<qwsm::Timestamp>& stamps) {
  constexpr std::string_view kWhole = ".000000000";
  std::string text;
  for (std::size_t scan = 0; scan < T_map_scan.size(); ++scan) {
    const Eigen::Vector3d& t = T_map_scan[scan].translation_m;
    const Eigen::Quaterniond q(T_map_scan[scan].rotation);
    qwsm::io::AppendStamp(text, stamps[scan]);
    if (text.ends_with(kWhole)) text.erase(text.size() - kWhole.size());  // As of a number.
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += ' ';
      qwsm::io::AppendNumber(text, value);
    }
    text += '\n';
  }
  qwsm::io::WriteTextFile(file, text);
}

void WriteTum3(const fs::path& file, const std::vector<Pose3>& T_map_scan) {
  std::vector<qwsm::Timestamp> numbers;
  for (std::size_t scan = 0; scan < T_map_scan.size(); ++scan) {
    numbers.push_back(std::chrono::seconds(scan));
  }
  WriteTum3(file, T_map_scan, numbers);
}

void WriteKitti3(const fs::path& file, const std::vector<Pose3>& T_map_scan) {
  std::string text;
  for (const Pose3& pose : T_map_scan) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        const double value = column < 3 ? pose.rotation(row, column) : pose.translation_m(row);
        qwsm::io::AppendNumber(text, value);
        text += row == 2 && column == 3 ? '\n' : ' ';
      }
    }
  }
  qwsm::io::WriteTextFile(file, text);
}

NumberedPoses ReadPoses(const fs::path& path) {
  if (!fs::is_directory(path)) return ReadTum3(path);
  if (fs::exists(path / "trajectory.tum")) return ReadTum3(path / "trajectory.tum");
  for (const char* ending : {".frames", ".pose"}) {
    NumberedPoses poses = ReadFolder(path, ending);
    if (!poses.empty()) return poses;
  }
  throw std::runtime_error(path.string() +
                           ": holds no trajectory.tum, no .frames and no .pose files");
}

NumberedPoses Renumbered(const NumberedPoses& poses, const std::vector<double>& numbers) {
  double count = 0.0;
  const bool are_counted =
      std::ranges::all_of(poses, [&](const auto& pose) { return pose.first == count++; });
  if (!are_counted || poses.size() != numbers.size()) return poses;
  NumberedPoses renumbered;
  for (auto number = numbers.begin(); const auto& [counted, pose] : poses) {
    renumbered.emplace(*number++, pose);
  }
  return renumbered;
}

}  // namespace slam6d::io
