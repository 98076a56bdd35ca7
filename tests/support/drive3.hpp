// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <vector>

#include "slam6d/mapping/slam.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {

/// Stops of a robot in the room of room3.hpp, on a circle that it closes.
struct Drive3 {
  std::vector<Pose3> T_room_scan;
  std::vector<Pose3> T_odom_scan;  ///< Drifts, and knows nothing of height, roll and pitch.
  std::vector<PointCloud> scans;
};

inline Drive3 DriveInCircle(int stops, int points, unsigned seed) {
  std::mt19937 random(seed);
  Drive3 drive;
  for (int stop = 0; stop < stops; ++stop) {
    const double angle_rad = 2.0 * std::numbers::pi * stop / (stops - 1.0);
    const Pose3 T_room_scan{
        .rotation = RotationFromRollPitchYaw(
            {0.03 * std::sin(3.0 * angle_rad), 0.02 * std::cos(2.0 * angle_rad), angle_rad}),
        .translation_m = {1.5 * std::sin(angle_rad),
                          -1.0 - std::cos(angle_rad),
                          0.8 + 0.05 * std::sin(angle_rad)}};
    drive.scans.push_back(
        ScanRoom(T_room_scan, points, 0.005, seed + 100 * static_cast<unsigned>(stop)));
    Pose3 T_odom_scan;
    if (stop > 0) {
      Pose3 step = drive.T_room_scan.back().Inverse() * T_room_scan;
      const Eigen::Vector3d error = DrawNormal(random, 0.03);
      step.translation_m += Eigen::Vector3d(error.x(), error.y(), -step.translation_m.z());
      const double yaw_rad = RollPitchYaw(step.rotation).z() + 0.02 + 0.3 * error.z();
      step.rotation = RotationFromRollPitchYaw({0.0, 0.0, yaw_rad});
      T_odom_scan = drive.T_odom_scan.back() * step;
    }
    drive.T_room_scan.push_back(T_room_scan);
    drive.T_odom_scan.push_back(T_odom_scan);
  }
  return drive;
}

/// The largest distance of the poses from the truth, both seen from the first stop.
inline double LargestErrorM(const std::vector<Pose3>& T_map_scan,
                            const std::vector<Pose3>& T_room_scan) {
  double largest_m = 0.0;
  for (std::size_t i = 0; i < T_map_scan.size(); ++i) {
    const Pose3 estimate = T_map_scan.front().Inverse() * T_map_scan[i];
    const Pose3 truth = T_room_scan.front().Inverse() * T_room_scan[i];
    largest_m = std::max(largest_m, (estimate.translation_m - truth.translation_m).norm());
  }
  return largest_m;
}

}  // namespace slam6d
