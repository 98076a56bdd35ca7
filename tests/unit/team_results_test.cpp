// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a service leaves of its robots, also where the disk is full for the table of one of them.
#include "service/pipeline/team/team_results.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
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

void Answer(TeamResults& results, const std::string& robot, int count) {
  for (int i = 0; i < count; ++i) {
    team::RobotAnswer answer{.robot = robot, .step = {}};
    answer.step.stamp = std::chrono::milliseconds(100) * i;
    results.TakeAnswer(answer);
  }
}

// Whoever reads all folders, as `qwsm export` does, would take them for robots of this run.
TEST(TeamResults, HaveNoFoldersOfRobotsOfAnEarlierRun) {
  const test::TemporaryFolder folder;
  const auto serve = [&](std::initializer_list<const char*> robots) {
    TeamResults results(ResultsFolder(folder.path(), false), {.rendering = {}});
    for (const char* robot : robots) Answer(results, robot, 3);
    team::TeamService service({}, results);
    results.Finish(service);
  };
  serve({"one", "two", "fleet/three", "noted"});
  EXPECT_TRUE(fs::exists(folder.path() / "two" / "trajectory.tum"));
  std::ofstream(folder.path() / "one" / "loops.csv") << "of a map of its own";
  std::ofstream(folder.path() / "noted" / "notes.txt") << "somebody's";
  serve({"one"});
  EXPECT_TRUE(fs::exists(folder.path() / "one" / "trajectory.tum"));
  EXPECT_FALSE(fs::exists(folder.path() / "one" / "loops.csv"));
  EXPECT_FALSE(fs::exists(folder.path() / "two"));
  EXPECT_FALSE(fs::exists(folder.path() / "fleet" / "three"));
  EXPECT_FALSE(fs::exists(folder.path() / "noted" / "trajectory.tum"));
  EXPECT_TRUE(fs::exists(folder.path() / "noted" / "notes.txt"));
}

class TeamResultsOnAFullDisk : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    fs::create_directory(folder_.path() / "unlucky");
    fs::create_symlink("/dev/full", folder_.path() / "unlucky" / "scans.csv.part");
  }

  void AnswerBoth(int count) {
    for (const char* robot : {"lucky", "unlucky"}) Answer(*results_, robot, count);
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
  AnswerBoth(2000);
  EXPECT_NO_THROW(Finish());  // It was told when it was noticed.
  results_.reset();
  EXPECT_GT(CountOfLines(folder_.path() / "unlucky" / "trajectory_live.tum.part"), 100);
  EXPECT_EQ(CountOfLines(folder_.path() / "lucky" / "trajectory_live.tum"), 2000);
  EXPECT_EQ(CountOfLines(folder_.path() / "lucky" / "scans.csv"), 2001);
}

TEST_F(TeamResultsOnAFullDisk, ThatIsNoticedInTheEndCostNoOtherRobotItsOwn) {
  AnswerBoth(20);  // All of it fits in a buffer.
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
