// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/scan_points.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "service/io/clouds/ply_file.hpp"
#include "service/io/clouds/trajectory3_file.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace slam6d::io {
namespace {

namespace fs = std::filesystem;

std::string Bytes(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

class PointFiles : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  qwsm::test::TemporaryFolder folder_;
};

TEST_F(PointFiles, ReadXyzWithHeadingAndFurtherColumns) {
  const ScanPoints points =
      ReadScanPoints(Write("a.xyz", "x y z intensity\n1 2 3 0.5\r\n4;5;6\n\n7,8,9\n"));
  ASSERT_EQ(points.cloud.size(), 3U);
  EXPECT_EQ(points.skipped_lines, 0U);
  EXPECT_EQ(points.cloud[2], Eigen::Vector3d(7.0, 8.0, 9.0));
}

TEST_F(PointFiles, ReadPlyInBothForms) {
  const std::string properties =
      "element vertex 2\nproperty float x\nproperty uchar red\nproperty float y\n"
      "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  const ScanPoints text = ReadScanPoints(
      Write("a.ply", "ply\nformat ascii 1.0\n" + properties + "1 255 2 3\n4 0 5 6\n"));
  std::string records;
  for (const auto& [x, y, z] : {std::array{1.0F, 2.0F, 3.0F}, std::array{4.0F, 5.0F, 6.0F}}) {
    records += Bytes({x}) + '\x7f' + Bytes({y, z});
  }
  const ScanPoints binary = ReadScanPoints(
      Write("b.ply", "ply\r\nformat binary_little_endian 1.0\n" + properties + records));
  for (const ScanPoints& points : {text, binary}) {
    ASSERT_EQ(points.cloud.size(), 2U);
    EXPECT_EQ(points.skipped_lines, 0U) << points.first_problem;
    EXPECT_EQ(points.cloud[1], Eigen::Vector3d(4.0, 5.0, 6.0));
  }
}

TEST_F(PointFiles, ReadPcdInBothForms) {
  const std::string header =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
      "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
  const ScanPoints text =
      ReadScanPoints(Write("a.pcd", header + "DATA ascii\n1 2 3 nan\n4 5 nan 0\n"));
  ASSERT_EQ(text.cloud.size(), 1U);
  EXPECT_EQ(text.skipped_lines, 1U);
  EXPECT_NE(text.first_problem.find("a.pcd:13: expected finite numbers"), std::string::npos)
      << text.first_problem;
  const ScanPoints binary = ReadScanPoints(Write(
      "b.pcd", header + "DATA binary\n" + Bytes({1.0F, 2.0F, 3.0F, 0.0F, 4.0F, 5.0F, 6.0F, 0.0F})));
  ASSERT_EQ(binary.cloud.size(), 2U);
  EXPECT_EQ(binary.cloud[1], Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST_F(PointFiles, ReadKittiAndKeepWhatStandsBeforeACut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const ScanPoints points = ReadScanPoints(
      Write("0.bin", Bytes({1.0F, 2.0F, 3.0F, 0.5F, nan, 0.0F, 0.0F, 0.0F, 4.0F, 5.0F})));
  ASSERT_EQ(points.cloud.size(), 1U);
  EXPECT_EQ(points.skipped_lines, 2U);
  EXPECT_NE(points.first_problem.find("point 1 is not finite"), std::string::npos);
}

TEST_F(PointFiles, KeepWhatStandsBeforeTheEndOfACutBinaryFile) {
  PointCloud cloud;
  for (int i = 0; i < 100; ++i) cloud.push_back({0.5 * i, 0.0, -1.0});
  const fs::path file = folder_.path() / "model.ply";
  WritePly(file, cloud);
  EXPECT_EQ(ReadScanPoints(file).cloud.size(), 100U);
  fs::resize_file(file, fs::file_size(file) - 18);
  const ScanPoints cut = ReadScanPoints(file);
  EXPECT_EQ(cut.cloud.size(), 98U);
  EXPECT_NE(cut.first_problem.find("ends after 98 of 100 points"), std::string::npos);
}

TEST_F(PointFiles, KeepModelsToAMillimetreWhereverTheyLie) {
  const Eigen::Vector3d far_m{432'101.0625, 5'432'101.0625, 51.0625};
  PointCloud cloud;
  cloud.push_back(far_m);
  const fs::path file = folder_.path() / "far.ply";
  WritePly(file, cloud);
  ASSERT_EQ(ReadScanPoints(file).cloud.size(), 1U);
  EXPECT_EQ(ReadScanPoints(file).cloud[0], far_m);
  const std::uintmax_t of_doubles = fs::file_size(file);
  cloud.Set(0, {1.0, -2.0, 3.0});
  WritePly(file, cloud);
  EXPECT_LT(fs::file_size(file), of_doubles);
  EXPECT_EQ(ReadScanPoints(file).cloud[0], Eigen::Vector3d(1.0, -2.0, 3.0));
}

TEST_F(PointFiles, MayHaveWholeNumbersOfEightBytesBesideTheirPoints) {
  const ScanPoints points =
      ReadScanPoints(Write("t.pcd",
                           "FIELDS t x y z\nSIZE 8 4 4 4\nTYPE U F F F\nPOINTS 1\nDATA binary\n" +
                               std::string(8, '\1') + Bytes({1.0F, 2.0F, 3.0F})));
  ASSERT_EQ(points.cloud.size(), 1U);
  EXPECT_EQ(points.cloud[0], Eigen::Vector3d(1.0, 2.0, 3.0));
}

TEST_F(PointFiles, SayWhatIsWrongWithAHeader) {
  const auto problem = [&](const std::string& name, const std::string& text) {
    try {
      static_cast<void>(ReadScanPoints(Write(name, text)));
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no exception");
  };
  EXPECT_NE(problem("a.ply", "plie\n").find("a.ply:1: a PLY file begins"), std::string::npos);
  EXPECT_NE(problem("b.ply", "ply\nformat binary_big_endian 1.0\n").find("b.ply:2: the format"),
            std::string::npos);
  EXPECT_NE(problem("c.ply", "ply\nformat ascii 1.0\nend_header\n").find("no fields x, y and z"),
            std::string::npos);
  EXPECT_NE(problem("d.ply", "ply\nelement vertex 1\nproperty float x\nend_header\n")
                .find("d.ply:4: the header has no line 'format'"),
            std::string::npos);
  EXPECT_NE(
      problem("e.ply", "ply\nformat ascii 1.0\nelement vertex -5\n").find("'-5' in the header"),
      std::string::npos);
  EXPECT_NE(problem("n.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS -5\nDATA ascii\n")
                .find("'-5' in the header is no count"),
            std::string::npos);
  EXPECT_NE(problem("a.pcd", "no header\n").find("this is no PCD file"), std::string::npos);
  EXPECT_NE(problem("a.las", "LASF").find("not a known file of points"), std::string::npos);
}

TEST_F(PointFiles, WithHeadersThatMakeNoSenseAreRefused) {
  const auto problem = [&](const std::string& count, const std::string& points) {
    const std::string header = "FIELDS a x y z\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT " + count +
                               "\nPOINTS " + points + "\nDATA binary\n";
    try {
      return std::to_string(
          ReadScanPoints(Write("a.pcd", header + Bytes({1, 2, 3, 4}))).cloud.size());
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(problem("1 1 1 1", "1"), "1");
  EXPECT_EQ(problem("1 1 1 1", "0"), "0");
  EXPECT_EQ(problem("1 1 1 1", "99999999999999999"), "1");
  EXPECT_NE(problem("0 0 0 0", "1").find("names no fields x, y and z"), std::string::npos);
  EXPECT_NE(problem("1 1 1 0", "1").find("names no fields x, y and z"), std::string::npos);
  EXPECT_NE(problem("4611686018427387904 1 1 1", "1").find("more than 10000 numbers"),
            std::string::npos);
}

TEST_F(PointFiles, LeaveOutPointsThatNoScannerCanHaveSeen) {
  const ScanPoints points =
      ReadScanPoints(Write("a.xyz", "1 2 3\n1e9 0 0\n4000000 5500000 100\n0 0 -1e300\n"));
  EXPECT_EQ(points.cloud.size(), 2U);
  EXPECT_EQ(points.skipped_lines, 2U);
  EXPECT_NE(points.first_problem.find("a.xyz: point 1 is more than 10000 km away"),
            std::string::npos);
}

TEST_F(PointFiles, WithPosesThatAreNowhereAreRefused) {
  const fs::path pose = Write("scan000.pose", "1e12 0 0\n0 0 0\n");
  EXPECT_THROW(ReadUosPose(pose), std::runtime_error);
  const fs::path tum = Write("poses.tum", "0 0 1e9 0 0 0 0 1\n");
  EXPECT_THROW(ReadPoses(tum), std::runtime_error);
}

TEST_F(PointFiles, WithTwoPosesOfOneScanAreRefused) {
  const auto complaint = [](const fs::path& poses) -> std::string {
    try {
      ReadPoses(poses);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  };
  const fs::path tum = Write("poses.tum", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n0 2 0 0 0 0 0 1\n");
  EXPECT_NE(complaint(tum).find("poses.tum:3: a pose of this number or stamp stands before"),
            std::string::npos)
      << complaint(tum);
  const fs::path folder = folder_.path() / "poses";
  fs::create_directory(folder);
  Write("poses/scan001.pose", "0 0 0\n0 0 0\n");
  Write("poses/scan1.pose", "1 0 0\n0 0 0\n");
  EXPECT_NE(complaint(folder).find(": another file has the number 1, too"), std::string::npos)
      << complaint(folder);
}

TEST_F(PointFiles, AreInTheUnitThatIsStated) {
  const fs::path xyz = Write("a.xyz", "1000 0 0\n");
  const fs::path uos = Write("a.3d", "0 0 1\n");
  EXPECT_NEAR(ReadScanPoints(xyz, {.unit_m = 0.001}).cloud[0].x(), 1.0, 1e-12);
  EXPECT_NEAR(ReadScanPoints(uos, {.uos_unit_m = 1.0}).cloud[0].x(), 1.0, 1e-12);
  EXPECT_EQ(ScanName("in/scan007.3d.gz"), "scan007");
}

TEST_F(PointFiles, PosesComeBackFromFramesAndTum) {
  const Pose3 pose{.rotation = RotationFromRollPitchYaw({0.1, -0.2, 2.5}),
                   .translation_m = {1.5, -2.5, 0.3}};
  WriteUosFrames(folder_.path() / "scan003.frames", {}, pose);
  const NumberedPoses frames = ReadPoses(folder_.path());
  WriteTum3(folder_.path() / "trajectory.tum", {{}, pose});
  const NumberedPoses tum = ReadPoses(folder_.path());
  for (const Pose3& read : {frames.at(3.0), tum.at(1.0)}) {
    EXPECT_LT((read.translation_m - pose.translation_m).norm(), 1e-12);
    EXPECT_LT(RotationAngle(read.rotation.transpose() * pose.rotation), 1e-12);
  }
}

TEST_F(PointFiles, PosesOfKittiAreTheUpperRowsOfTheirMatrices) {
  const fs::path file = folder_.path() / "trajectory.kitti";
  WriteKitti3(file, {{}, {.translation_m = {1.5, -2.5, 0.25}}});
  EXPECT_EQ(qwsm::test::ReadFile(file),
            "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1.5 0 1 0 -2.5 0 0 1 0.25\n");
}

}  // namespace
}  // namespace slam6d::io
