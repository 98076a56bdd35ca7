// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/results_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

class ResultsFolderTest : public ::testing::Test {
 protected:
  void Put(const char* name) const { std::ofstream(folder_.path() / name) << "text"; }
  bool Has(const char* name) const { return fs::exists(fs::symlink_status(results_ / name)); }

  test::TemporaryFolder folder_;
  fs::path results_ = folder_.path();
};

TEST_F(ResultsFolderTest, RemovesWhatAnEarlierRunWroteAndNothingElse) {
  for (const bool force : {false, true}) {
    const ResultsFolder first(results_, true);
    for (const char* ours : {"report.html", "trajectory.tum.part", "scan000.frames"}) Put(ours);
    for (const char* other : {"notes.txt", "site.qwsm", "rec.log", "scan.3d", "a.part"}) Put(other);
    if (!Has("link.log")) fs::create_symlink("/nowhere", results_ / "link.log");
    const ResultsFolder second(results_, force);
    for (const char* ours : {"report.html", "trajectory.tum.part", "scan000.frames"}) {
      EXPECT_FALSE(Has(ours)) << ours;
    }
    for (const char* other :
         {"notes.txt", "site.qwsm", "rec.log", "scan.3d", "a.part", "link.log"}) {
      EXPECT_TRUE(Has(other)) << other;
    }
  }
}

// As of s7.pcd or 1305031102.xyz; in a folder that no program has written they are somebody's own.
TEST_F(ResultsFolderTest, RemovesFramesOfAnyNameWhereAnEarlierRunWasAndNowhereElse) {
  Put("s7.frames");
  const ResultsFolder first(results_, true);
  EXPECT_TRUE(Has("s7.frames"));
  const ResultsFolder second(results_, false);
  EXPECT_FALSE(Has("s7.frames"));
}

TEST_F(ResultsFolderTest, HasNoPartsOfAnEarlierRunButWhatElseIsInThem) {
  const ResultsFolder first(results_, true);
  for (const char* part : {"robot1", "fleet", "fleet/robot2", "noted"}) {
    EXPECT_EQ(first.Part(part, false).path(), results_ / part);
    Put((std::string(part) + "/trajectory.tum").c_str());
  }
  Put("noted/notes.txt");
  EXPECT_EQ(first.Part("", false).path(), results_);
  const ResultsFolder second(results_, false);
  for (const char* gone : {"robot1", "fleet", "noted/trajectory.tum"}) {
    EXPECT_FALSE(Has(gone)) << gone;
  }
  EXPECT_TRUE(Has("noted/notes.txt"));
  EXPECT_EQ(second.Part("noted", false).path(), results_ / "noted");  // Still known as one of ours.
}

// Runs that had a folder in it of their own, a part that somebody keeps a copy of, or has put
// elsewhere, and whatever else a marker may name.
TEST_F(ResultsFolderTest, KeepsResultsThatAreNoPartOfTheEarlierRun) {
  const ResultsFolder first(results_ / "run", false);
  for (const char* part : {"robot1", "robot2", "robot3"}) {
    const ResultsFolder folder = first.Part(part, false);
    Put((std::string("run/") + part + "/trajectory.tum").c_str());
  }
  fs::copy(results_ / "run/robot1", results_ / "run/copy", fs::copy_options::recursive);
  const ResultsFolder own(results_ / "run/robot2", false);
  Put("run/robot2/trajectory.tum");
  fs::rename(results_ / "run/robot3", results_ / "elsewhere");
  fs::create_directory_symlink(results_ / "elsewhere", results_ / "run/robot3");
  std::ofstream(results_ / "run/.qwsm-results", std::ios::app)
      << "part ../elsewhere\npart .\npart \npart " << (results_ / "elsewhere").string() << '\n';
  const ResultsFolder second(results_ / "run", false);
  EXPECT_FALSE(Has("run/robot1"));
  for (const char* kept : {"run/copy/trajectory.tum",
                           "run/robot2/trajectory.tum",
                           "run/robot3",
                           "elsewhere/trajectory.tum"}) {
    EXPECT_TRUE(Has(kept)) << kept;
  }
}

TEST_F(ResultsFolderTest, RefusesAnInputThatIsInAPartOfAnEarlierRun) {
  const ResultsFolder first(results_, true);
  const std::array inputs{first.Part("robot1", false) / "answers.mcap"};
  Put("robot1/answers.mcap");
  EXPECT_THROW(ResultsFolder(results_, true, inputs), io::WriteError);
  EXPECT_TRUE(Has("robot1/answers.mcap"));
}

TEST_F(ResultsFolderTest, RefusesAnInputThatIsInItByALink) {
  const fs::path results = results_ / "results";
  fs::create_directory(results);
  std::ofstream(results / "rec.log") << "text";
  fs::create_symlink(results / "rec.log", results_ / "link.log");
  const std::array inputs{results_ / "link.log"};
  EXPECT_THROW(ResultsFolder::Check(results, true, inputs), io::WriteError);
}

TEST_F(ResultsFolderTest, IsAnotherOneForEachRunThatBeginsNow) {
  constexpr std::size_t kRuns = 8;
  constexpr std::size_t kTimes = 20;
  std::array<std::set<fs::path>, kRuns> folders;
  {
    std::vector<std::jthread> runs;
    for (std::set<fs::path>& of_run : folders) {
      runs.emplace_back([&] {
        for (std::size_t i = 0; i < kTimes; ++i) {
          of_run.insert(ResultsFolder::ForNow(results_ / "results").path());
        }
      });
    }
  }
  std::set<fs::path> all;
  for (const std::set<fs::path>& of_run : folders) all.insert(of_run.begin(), of_run.end());
  EXPECT_EQ(all.size(), kRuns * kTimes);
  EXPECT_TRUE(fs::is_directory(results_ / "results" / "latest"));
}

}  // namespace
}  // namespace qwsm::pipeline
