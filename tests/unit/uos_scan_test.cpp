// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/uos_scan.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <stdexcept>
#include <string>

namespace slam6d::io {
namespace {

std::filesystem::path Write(const std::string& name, const std::string& text) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(UosScan, TurnsCentimetresRightUpForwardIntoMetresForwardLeftUp) {
  const ScanPoints points = ReadUosPoints(Write("scan_axes.3d", "100 200 300\n"));
  ASSERT_EQ(points.cloud.size(), 1U);
  EXPECT_NEAR((points.cloud[0] - Eigen::Vector3d(3.0, -1.0, 2.0)).norm(), 0.0, 1e-12);
}

TEST(UosScan, KeepsTheRestWhenLinesAreBadAndNamesTheFirst) {
  const std::filesystem::path file =
      Write("scan_bad.3d", "1 2 3\r\n\r\n# note\n4 nan 6\n7 8\n9 10 11 0.5\r\n12 13 x\n+1 -2 3e1");
  const ScanPoints points = ReadUosPoints(file);
  EXPECT_EQ(points.cloud.size(), 3U);
  EXPECT_EQ(points.skipped_lines, 3U);
  EXPECT_EQ(points.first_problem, file.string() + ":4: expected three finite numbers 'x y z'");
}

TEST(UosScan, AYawToTheRightIsNegativeForUs) {
  // 3DTK: a positive angle about the upward axis turns forward to the right.
  const Pose3 pose = ReadUosPose(Write("scan_yaw.pose", "100 50 200\r\n0 90 0\r\n"));
  EXPECT_NEAR((pose.translation_m - Eigen::Vector3d(2.0, -1.0, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(
      (pose.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
  EXPECT_NEAR(pose.rotation.determinant(), 1.0, 1e-12);
}

TEST(UosScan, NamesFileAndLineOfABrokenPose) {
  const std::filesystem::path file = Write("scan_broken.pose", "1 2 3\n4 5\n");
  try {
    static_cast<void>(ReadUosPose(file));
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), file.string() + ":2: expected three angles in degrees");
  }
  const std::filesystem::path spinning = Write("scan_spinning.pose", "1 2 3\n0 1e300 0\n");
  EXPECT_THROW(static_cast<void>(ReadUosPose(spinning)), std::runtime_error);
  EXPECT_THROW(static_cast<void>(ReadUosPose("/nowhere/scan000.pose")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(ReadUosPoints("/nowhere/scan000.3d")), std::runtime_error);
}

}  // namespace
}  // namespace slam6d::io
