// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Two clouds of one hall, scanned from places 30 cm and 5 degrees apart: where was the second?
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>

#include "slam6d/icp/icp.hpp"

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// What a scanner sees of floor, ceiling and walls of a hall of 8 x 6 x 3 metres, from its pose;
/// the hall's frame lies in the middle of the floor. Points are off by a centimetre.
slam6d::PointCloud ScanHall(const slam6d::Pose3& T_hall_scanner, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> across(-1.0, 1.0);
  std::normal_distribution<double> noise_m(0.0, 0.01);
  const Eigen::Array3d half_size_m(4.0, 3.0, 1.5);
  const slam6d::Pose3 T_scanner_hall = T_hall_scanner.Inverse();
  slam6d::PointCloud cloud;
  for (int i = 0; i < 30000; ++i) {
    Eigen::Array3d place(across(random), across(random), across(random));
    place(i % 3) = place(i % 3) < 0.0 ? -1.0 : 1.0;  // Onto one of the six sides.
    const Eigen::Vector3d error_m(noise_m(random), noise_m(random), noise_m(random));
    const Eigen::Vector3d p_hall_m = half_size_m * place + Eigen::Array3d(0.0, 0.0, 1.5);
    cloud.push_back(T_scanner_hall * p_hall_m + error_m);
  }
  return cloud;
}

}  // namespace

int main() {
  const slam6d::Pose3 T_hall_ref{.translation_m = {0.5, -0.4, 1.0}};
  const slam6d::Pose3 T_ref_cur_true{
      .rotation = slam6d::RotationFromRollPitchYaw({0.5 * kDegree, 0.0, 5.0 * kDegree}),
      .translation_m = {0.3, 0.1, 0.0}};

  // A model is a cloud with its kd-tree and its surfaces: made once, registered as often as wanted.
  const slam6d::ScanModel ref(ScanHall(T_hall_ref, 1));
  const slam6d::ScanModel cur(ScanHall(T_hall_ref * T_ref_cur_true, 2));
  const slam6d::Pose3 guess;  // Nothing is known but that the scanner has hardly moved.
  const slam6d::IcpResult result = slam6d::Align(ref, cur, guess, slam6d::IcpOptions());

  const slam6d::Pose3 error = T_ref_cur_true.Inverse() * result.T_ref_cur;
  std::cout << Name(result.status) << " after " << result.iterations << " iterations, "
            << result.pairs << " pairs\n"
            << "at " << result.T_ref_cur.translation_m.transpose() << " m, turned by "
            << slam6d::RotationAngle(result.T_ref_cur.rotation) / kDegree << " deg\n"
            << "off by " << 1e3 * error.translation_m.norm() << " mm and "
            << slam6d::RotationAngle(error.rotation) / kDegree << " deg\n";
  return error.translation_m.norm() < 0.005 ? EXIT_SUCCESS : EXIT_FAILURE;
}
