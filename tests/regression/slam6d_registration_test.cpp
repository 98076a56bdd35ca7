// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Registration of the shared scan pairs against their true poses.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "service/io/clouds/uos_scan.hpp"
#include "slam6d/mapping/slam.hpp"

namespace slam6d {
namespace {

struct Errors {
  double centimetres;
  double degrees;
};

Pose3 RelativePose(const std::filesystem::path& poses) {
  return io::ReadUosPose(poses / "scan000.pose").Inverse() *
         io::ReadUosPose(poses / "scan001.pose");
}

Errors ErrorsOf(const Pose3& T_ref_cur, const std::filesystem::path& truth) {
  const Pose3 error = RelativePose(truth).Inverse() * T_ref_cur;
  return {.centimetres = 100.0 * error.translation_m.norm(),
          .degrees = RotationAngle(error.rotation) * 180.0 / std::numbers::pi};
}

Errors Register(const std::filesystem::path& folder, const IcpOptions& options) {
  const ScanModel ref(io::ReadUosPoints(folder / "scan000.3d").cloud);
  const ScanModel cur(io::ReadUosPoints(folder / "scan001.3d").cloud);
  const IcpResult result = Align(ref, cur, RelativePose(folder), options);
  EXPECT_EQ(result.status, IcpStatus::kConverged);
  return ErrorsOf(result.T_ref_cur, folder / "gt");
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

// Hardly a plane in them: the flat pieces of leaves agree to centimetres only.
TEST(Registration, PlanesAlignTheScansOfACarAsWell) {
  const std::filesystem::path folder = std::filesystem::path(QWSM_DATA_DIR) / "scans3d/car";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no scans in " << folder;
  const PathLoopCloser closer;
  Slam slam({.refinement = {.enabled = true}}, closer);
  for (const char* name : {"scan000", "scan001"}) {
    const std::filesystem::path scan = folder / name;
    static_cast<void>(slam.Add(io::ReadUosPoints(scan.string() + ".3d").cloud,
                               io::ReadUosPose(scan.string() + ".pose")));
  }
  const auto expect_errors_below = [&](const Errors& bound) {
    const Errors errors =
        ErrorsOf(slam.T_map_scan()[0].Inverse() * slam.T_map_scan()[1], folder / "gt");
    EXPECT_LE(errors.centimetres, bound.centimetres);
    EXPECT_LE(errors.degrees, bound.degrees);
  };
  expect_errors_below({.centimetres = 3.5, .degrees = 0.28});
  static_cast<void>(slam.Refine());
  expect_errors_below({.centimetres = 4.0, .degrees = 0.35});
}

}  // namespace
}  // namespace slam6d
