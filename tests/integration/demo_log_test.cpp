// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The log of the demonstration: generated, mapped by the program, and compared with the truth.
#include "tests/support/demo_log.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "qwsm/metrics/trajectory_error.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

TEST(DemoLog, IsMappedToWithinCentimetresOfTheTruth) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "demo.log";
  const fs::path truth = folder.path() / "truth.tum";
  const fs::path results = folder.path() / "results";
  WriteDemoLog(log, truth);
  ASSERT_EQ(RunProgram({"map", log, "--output", results}).exit_code, 0);

  const std::vector<PosePair> pairs =
      Associate(io::ReadTumFile(truth), io::ReadTumFile(results / "trajectory.tum"), {});
  ASSERT_GT(pairs.size(), 250U);
  // Both begin in the frame of the first pose: no alignment, which would hide drift.
  EXPECT_LT(AbsoluteTrajectoryError(pairs, Pose2{}).rmse, 0.05);
}

}  // namespace
}  // namespace qwsm::test
