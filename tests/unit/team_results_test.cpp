// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a service leaves of its robots where the disk is full for the table of one of them.
#include "service/pipeline/team/team_results.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

std::ptrdiff_t CountOfLines(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
}

class TeamResultsOnAFullDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    fs::create_directory(folder_.path() / "unlucky");
    fs::create_symlink("/dev/full", folder_.path() / "unlucky" / "scans.csv.part");
  }

  /// Answers each of both robots.
  void Answer(int count) {
    for (int i = 0; i < count; ++i) {
      for (const char* robot : {"lucky", "unlucky"}) {
        team::RobotAnswer answer{.robot = robot, .step = {}};
        answer.step.stamp = std::chrono::milliseconds(100) * i;
        results_->TakeAnswer(answer);
      }
    }
  }
  void Finish() {
    team::TeamService service({}, *results_);
    results_->Finish(service);
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<TeamResults> results_ = std::make_unique<TeamResults>(
      ResultsFolder(folder_.path(), true), TeamResultsOptions{.rendering = {}});
};

TEST_F(TeamResultsOnAFullDisk, KeepTheHalfThatCouldBeWritten) {
  Answer(2000);
  EXPECT_NO_THROW(Finish());  // It was told when it was noticed.
  results_.reset();
  EXPECT_GT(CountOfLines(folder_.path() / "unlucky" / "trajectory_live.tum.part"), 100);
  EXPECT_EQ(CountOfLines(folder_.path() / "lucky" / "trajectory_live.tum"), 2000);
  EXPECT_EQ(CountOfLines(folder_.path() / "lucky" / "scans.csv"), 2001);
}

TEST_F(TeamResultsOnAFullDisk, ThatIsNoticedInTheEndCostNoOtherRobotItsOwn) {
  Answer(20);  // All of it fits in a buffer.
  try {
    Finish();
    FAIL() << "nothing was thrown";
  } catch (const io::WriteError& error) {
    const std::string trajectory = folder_.path() / "unlucky" / "trajectory_live.tum";
    EXPECT_NE(std::string(error.what())
                  .find("No space left on device; what was written before is "
                        "in " +
                        trajectory),
              std::string::npos)
        << error.what();
    EXPECT_EQ(CountOfLines(trajectory), 20);
  }
  EXPECT_EQ(CountOfLines(folder_.path() / "lucky" / "trajectory_live.tum"), 20);
  EXPECT_TRUE(fs::exists(folder_.path() / "lucky" / "metrics.json"));
}

}  // namespace
}  // namespace qwsm::pipeline
