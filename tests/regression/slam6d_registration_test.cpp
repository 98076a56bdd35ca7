// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Registration of the shared scan pairs against their true poses.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "service/io/uos_scan.hpp"
#include "slam6d/mapping/slam.hpp"

namespace slam6d {
namespace {

struct Errors {
  double centimetres;
  double degrees;
};

Errors Register(const std::filesystem::path& folder, const IcpOptions& options) {
  const ScanModel ref(io::ReadUosPoints(folder / "scan000.3d").cloud);
  const ScanModel cur(io::ReadUosPoints(folder / "scan001.3d").cloud);
  const auto relative = [](const std::filesystem::path& poses) {
    return io::ReadUosPose(poses / "scan000.pose").Inverse() *
           io::ReadUosPose(poses / "scan001.pose");
  };
  const IcpResult result = Align(ref, cur, relative(folder), options);
  EXPECT_EQ(result.status, IcpStatus::kConverged);
  const Pose3 error = relative(folder / "gt").Inverse() * result.T_ref_cur;
  return {.centimetres = 100.0 * error.translation_m.norm(),
          .degrees = RotationAngle(error.rotation) * 180.0 / std::numbers::pi};
}

void ExpectErrorsBelow(const std::string& set, const IcpOptions& options, const Errors& bound) {
  const std::filesystem::path folder = std::filesystem::path(QWSM_DATA_DIR) / "scans3d" / set;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no scans in " << folder;
  const Errors errors = Register(folder, options);
  EXPECT_LE(errors.centimetres, bound.centimetres);
  EXPECT_LE(errors.degrees, bound.degrees);
}

TEST(Registration, PlanesAlignTwentyThousandPoints) {
  ExpectErrorsBelow("p20k", {}, {.centimetres = 0.13, .degrees = 0.004});
}

TEST(Registration, PlanesAlignAHundredThousandPoints) {
  ExpectErrorsBelow("p100k", {}, {.centimetres = 0.04, .degrees = 0.003});
}

TEST(Registration, PointsAlignTwentyThousandPoints) {
  ExpectErrorsBelow(
      "p20k", {.metric = IcpMetric::kPointToPoint}, {.centimetres = 1.07, .degrees = 0.064});
}

TEST(Registration, PointsAlignTheScansOfACar) {
  ExpectErrorsBelow(
      "car", {.metric = IcpMetric::kPointToPoint}, {.centimetres = 1.45, .degrees = 1.45});
}

TEST(Registration, TakesPointsWherePlanesLeadAstray) {
  const std::filesystem::path folder = std::filesystem::path(QWSM_DATA_DIR) / "scans3d/car";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no scans in " << folder;
  const PathLoopCloser closer;
  Slam slam({}, closer);
  for (const char* name : {"scan000", "scan001"}) {
    const std::filesystem::path scan = folder / name;
    static_cast<void>(slam.Add(io::ReadUosPoints(scan.string() + ".3d").cloud,
                               io::ReadUosPose(scan.string() + ".pose")));
  }
  const auto error_m = [&] {
    const Pose3 truth = io::ReadUosPose(folder / "gt/scan000.pose").Inverse() *
                        io::ReadUosPose(folder / "gt/scan001.pose");
    const Pose3 estimate = slam.T_map_scan()[0].Inverse() * slam.T_map_scan()[1];
    return (truth.Inverse() * estimate).translation_m.norm();
  };
  EXPECT_LE(error_m(), 0.0145);
  static_cast<void>(slam.Refine());
  EXPECT_LE(error_m(), 0.025);
}

}  // namespace
}  // namespace slam6d
