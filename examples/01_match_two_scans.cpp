// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Two scans of one room: how did the robot move between them, and how sure is that?
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "qwsm/match_scans.hpp"

namespace {

/// What a laser of 181 beams over 180 degrees measures in an empty room of 6 x 4 metres.
qwsm::LaserScan ScanRoom(const qwsm::Pose2& T_room_robot) {
  const auto step_rad = static_cast<float>(qwsm::DegreesToRadians(1.0));
  qwsm::LaserScan scan;
  scan.geometry.first_bearing_rad = -90 * step_rad;
  scan.geometry.bearing_step_rad = step_rad;
  scan.geometry.range_max_m = 30.0F;
  for (std::size_t beam = 0; beam < 181; ++beam) {
    const double angle_rad = T_room_robot.theta_rad + scan.geometry.Bearing(beam);
    const double to_wall_x = std::copysign(3.0, std::cos(angle_rad)) - T_room_robot.x_m;
    const double to_wall_y = std::copysign(2.0, std::sin(angle_rad)) - T_room_robot.y_m;
    scan.ranges_m.push_back(static_cast<float>(
        std::min(to_wall_x / std::cos(angle_rad), to_wall_y / std::sin(angle_rad))));
  }
  return scan;
}

}  // namespace

int main() {
  const qwsm::Pose2 T_ref_cur_true{0.20, 0.05, qwsm::DegreesToRadians(6.0)};
  // Odometry, if there were any, would be the third argument.
  const qwsm::MatchResult match = qwsm::MatchScans(ScanRoom({}), ScanRoom(T_ref_cur_true));

  const qwsm::UncertainPose2 motion{match.T_ref_cur, match.covariance};
  const qwsm::Pose2 error = T_ref_cur_true.Inverse() * match.T_ref_cur;
  std::cout << Name(match.status) << ": x " << motion.T_a_b.x_m << ", y " << motion.T_a_b.y_m
            << " +- " << motion.SigmaXY_m() << " m, heading "
            << qwsm::RadiansToDegrees(motion.T_a_b.theta_rad) << " +- "
            << qwsm::RadiansToDegrees(motion.SigmaTheta_rad()) << " deg\n"
            << "off by " << 1e3 * error.translation_m().norm() << " mm\n";
  return error.translation_m().norm() < 0.01 ? EXIT_SUCCESS : EXIT_FAILURE;
}
