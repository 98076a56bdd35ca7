// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "tests/support/drive3.hpp"

namespace slam6d {

/// Centimetres, left-handed: x right, y up, z forward.
inline void WriteUos(const std::filesystem::path& file,
                     const PointCloud& cloud,
                     double unit_m = 0.01) {
  std::ofstream stream(file);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud[i] / unit_m;
    stream << -p.y() << ' ' << p.z() << ' ' << p.x() << '\n';
  }
}

/// Odometry in the plane: the only angle is about the axis that points up.
inline void WriteUosPose(const std::filesystem::path& file, const Pose3& pose) {
  const Eigen::Vector3d t_cm = 100.0 * pose.translation_m;
  const double yaw_deg = RollPitchYaw(pose.rotation).z() * 180.0 / std::numbers::pi;
  std::ofstream(file) << -t_cm.y() << ' ' << t_cm.z() << ' ' << t_cm.x() << "\r\n0 " << -yaw_deg
                      << " 0\r\n";
}

/// A folder of scans and odometry as 3DTK has it.
inline void WriteUosDrive(const std::filesystem::path& folder, const Drive3& drive) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    const std::string name = "scan" + std::to_string(1000 + i).substr(1);
    WriteUos(folder / (name + ".3d"), drive.scans[i]);
    WriteUosPose(folder / (name + ".pose"), drive.T_odom_scan[i]);
  }
}

}  // namespace slam6d
