// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The program slam6d as its users run it, on scans of a room that are written as 3DTK would.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "service/io/clouds/ply_file.hpp"
#include "service/io/clouds/trajectory3_file.hpp"
#include "service/io/clouds/uos_scan.hpp"
#include "tests/support/drive3.hpp"
#include "tests/support/program.hpp"
#include "tests/support/uos_files.hpp"

namespace slam6d {
namespace {

namespace fs = std::filesystem;
using qwsm::test::Outcome;
using qwsm::test::ReadFile;

constexpr int kStops = 6;

/// Runs slam6d through the shell; `before` stands before it in the command.
Outcome RunSlam6d(const std::vector<std::string>& arguments, const std::string& before = "") {
  const qwsm::test::TemporaryFolder streams;
  std::string command =
      before + " '" + (qwsm::test::ProgramPath().parent_path() / "slam6d").string() + "'";
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  const fs::path output = streams.path() / "output";
  const fs::path errors = streams.path() / "errors";
  const int status =
      std::system((command + " >" + output.string() + " 2>" + errors.string()).c_str());
  return {.exit_code = WEXITSTATUS(status), .output = ReadFile(output), .errors = ReadFile(errors)};
}

class Slam6dProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(scans_);
    fs::create_directories(truth_);
    for (std::size_t i = 0; i < drive_.scans.size(); ++i) {
      WriteUos(Scan(i), drive_.scans[i]);
      WriteUosPose(scans_ / (Name(i) + ".pose"), drive_.T_odom_scan[i]);
      io::WriteUosFrames(truth_ / (Name(i) + ".frames"), {}, drive_.T_room_scan[i]);
    }
  }

  static std::string Name(std::size_t i) { return "scan00" + std::to_string(i); }
  fs::path Scan(std::size_t i) const { return scans_ / (Name(i) + ".3d"); }

  Outcome Register(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"register", scans_, "--output", results_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunSlam6d(arguments);
  }

  /// The largest distance of the poses in the results from the truth, scan 1 being where it is.
  double LargestErrorOfOthersM(std::size_t left_out) const {
    const io::NumberedPoses poses = io::ReadPoses(results_);
    double largest_m = 0.0;
    for (std::size_t i = 2; i < drive_.scans.size(); ++i) {
      if (i == left_out) continue;
      const Pose3 estimate = poses.at(1.0).Inverse() * poses.at(static_cast<double>(i));
      const Pose3 truth = drive_.T_room_scan[1].Inverse() * drive_.T_room_scan[i];
      largest_m = std::max(largest_m, (estimate.translation_m - truth.translation_m).norm());
    }
    return largest_m;
  }

  qwsm::test::TemporaryFolder folder_;
  fs::path scans_ = folder_.path() / "scans";
  fs::path truth_ = folder_.path() / "truth";
  fs::path results_ = folder_.path() / "results";
  Drive3 drive_ = DriveInCircle(kStops, 3000, 1);
};

TEST_F(Slam6dProgram, RegistersAFolderAndLeavesEverythingBehind) {
  const Outcome outcome = Register();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_NE(outcome.output.find("scans          6 of 6"), std::string::npos) << outcome.output;
  for (const char* name : {"trajectory.tum",
                           "scan000.frames",
                           "scan005.frames",
                           "scans.csv",
                           "metrics.json",
                           "config.yaml",
                           "run.log",
                           "top_before.png",
                           "top_after.png",
                           "side_before.png",
                           "side_after.png"}) {
    EXPECT_GT(fs::file_size(results_ / name), 50U) << name;
  }
  EXPECT_EQ(io::ReadPly(results_ / "model.ply").cloud.size(), kStops * 3000U);
  EXPECT_LT(LargestErrorOfOthersM(0), 0.01);
}

TEST_F(Slam6dProgram, JudgesItsResultsInBothForms) {
  ASSERT_EQ(Register().exit_code, 0);
  const fs::path tum = results_ / "trajectory.tum";
  for (const fs::path& estimate : {results_, tum}) {
    const Outcome good = RunSlam6d({"eval", estimate, "--truth", truth_, "--max-ate", "0.01"});
    EXPECT_EQ(good.exit_code, 0) << good.errors << good.output;
  }
  fs::remove(tum);  // Then the .frames are read.
  EXPECT_EQ(RunSlam6d({"eval", results_, "--truth", truth_, "--max-ate", "0.01"}).exit_code, 0);
  const Outcome bad = RunSlam6d({"eval", scans_, "--truth", truth_, "--max-ate", "0.01"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.errors.find("is above 0.01"), std::string::npos) << bad.errors;
}

TEST_F(Slam6dProgram, GivesTheSameFilesForAnyNumberOfThreads) {
  ASSERT_EQ(Register({"--threads", "1"}).exit_code, 0);
  const std::string expected = ReadFile(results_ / "trajectory.tum");
  ASSERT_EQ(Register({"--threads", "3"}).exit_code, 0);
  EXPECT_EQ(ReadFile(results_ / "trajectory.tum"), expected);
}

TEST_F(Slam6dProgram, LosesNothingToBadFiles) {
  std::ofstream(Scan(3), std::ios::app) << "1 nan 2\r\n1 2\n";
  const auto lines = static_cast<int>(drive_.scans[3].size());
  fs::remove(scans_ / "scan002.pose");
  std::ofstream(scans_ / "scan004.pose") << "1 2 three\n";
  std::ofstream(Scan(5), std::ios::trunc);
  const Outcome outcome = Register();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto says = [&](const std::string& what) {
    EXPECT_NE(outcome.errors.find(what), std::string::npos) << what << " not in " << outcome.errors;
  };
  says("scan003.3d:" + std::to_string(lines + 1) + ": expected three finite numbers");
  says("scan002.pose: is missing");
  says("scan004.pose:1: expected a position");
  says("scan005.3d: holds no points");
  EXPECT_LT(LargestErrorOfOthersM(5), 0.01);
}

TEST_F(Slam6dProgram, LeavesOutAScanInOtherUnits) {
  for (const std::size_t wrong : {0U, 4U}) {
    WriteUos(Scan(wrong), drive_.scans[wrong], 0.0001);
    const Outcome outcome = Register();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find(Name(wrong) + ".3d: half of its points"), std::string::npos)
        << outcome.errors;
    EXPECT_LT(LargestErrorOfOthersM(wrong), 0.01);
    WriteUos(Scan(wrong), drive_.scans[wrong]);
  }
}

TEST_F(Slam6dProgram, LosesNothingToScansOfOnePlace) {
  PointCloud one_place;
  for (int i = 0; i < 5000; ++i) one_place.push_back({3.0, 1.0, 0.5});
  PointCloud two_points;
  two_points.push_back({3.0, 1.0, 0.5});
  two_points.push_back({-2.0, 1.0, 0.5});
  for (const PointCloud& cloud : {one_place, two_points}) {
    WriteUos(Scan(3), cloud);
    const Outcome outcome = Register();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("scan003.3d: has fewer than three different points"),
              std::string::npos)
        << outcome.errors;
    EXPECT_LT(LargestErrorOfOthersM(3), 0.01);
  }
}

TEST_F(Slam6dProgram, WritesWhatItHasWhenInterrupted) {
  std::vector<std::string> arguments{"register", "--output", results_};
  for (int round = 0; round < 30; ++round) arguments.push_back(scans_);
  const Outcome outcome =
      RunSlam6d(arguments, "timeout --foreground --preserve-status --signal=INT 1");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_NE(outcome.errors.find("slam6d: interrupted"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(io::ReadPoses(results_).empty());
  EXPECT_TRUE(fs::exists(results_ / "model.ply"));
}

TEST_F(Slam6dProgram, SaysWhatIsWrongWithItsArguments) {
  const auto expect = [](std::vector<std::string> arguments, const std::string& what) {
    const Outcome outcome = RunSlam6d(std::move(arguments));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
  };
  const fs::path empty = folder_.path() / "empty";
  fs::create_directories(empty);
  expect({"register", empty}, "holds no scans");
  expect({"register", folder_.path() / "none.3d"}, "no such file");
  expect({"register", folder_.path() / "nowhere"}, "no such file or folder");
  std::ofstream(folder_.path() / "other.las") << "LASF";
  expect({"register", folder_.path() / "other.las"}, "not a known file of points");
  const fs::path nothing = folder_.path() / "nothing.ply";
  std::ofstream(nothing) << "ply\nformat binary_big_endian 1.0\n";
  expect({"register", nothing, "--output", results_}, "none of the scans has three");
  expect({"bench-search", nothing, nothing}, "format 'binary_big_endian' is not read");
  expect({"bench-search", scans_, "--max-range", "0.001"}, "no points to search");
  expect({"register", scans_, "--set", "slam.icp.metrik=svd"}, "did you mean");
  expect({"eval", empty, "--truth", truth_}, "holds no trajectory.tum");
  const fs::path stamped = folder_.path() / "stamped.tum";
  std::ofstream(stamped) << "100.5 0 0 0 0 0 0 1\n";
  expect(
      {"eval", truth_, "--truth", stamped},
      truth_.string() +
          ": no scan has a pose in both trajectories: here their numbers, or stamps, are 0 to 5, "
          "those of the truth 100.5 to 100.5");
  expect({"eval", truth_, "--truth", truth_, "--align", "2"}, "{none,first,best}");
  expect({"regster"}, "did you mean 'register'");
  const fs::path twins = folder_.path() / "twins.yaml";
  std::ofstream(twins) << "team:\n  robots:\n    - {name: a}\n    - {name: a}\n";
  expect({"serve", "--config", twins, "--output", results_}, "is the name of another robot");
}

TEST_F(Slam6dProgram, SaysThatFilesAreNotChosenLikeCloudsOfABag) {
  const Outcome outcome = RunSlam6d({"register", scans_, "--every", "2", "--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("choose from a bag"), std::string::npos) << outcome.errors;
  EXPECT_EQ(RunSlam6d({"register", scans_, "--dry-run"}).errors, "");
}

TEST_F(Slam6dProgram, ComparesSearches) {
  const fs::path figures = folder_.path() / "figures";
  const Outcome outcome = RunSlam6d({"bench-search", scans_, "--output", figures});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("speed-up"), std::string::npos) << outcome.output;
  EXPECT_TRUE(fs::exists(figures / "speed_up.png"));
  EXPECT_TRUE(fs::exists(figures / "iterations.png"));
}

TEST_F(Slam6dProgram, RegistersSimulatedDrives) {
  for (const std::string scenario : {"corridor", "office"}) {
    const std::string drive = folder_.path() / scenario;
    const Outcome simulated =
        RunSlam6d({"sim", scenario, "--output", drive, "--scans", "8", "--every", "1"});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.errors;
    ASSERT_EQ(RunSlam6d({"register", drive, "--output", results_, "--force"}).exit_code, 0);
    const Outcome evaluated =
        RunSlam6d({"eval", results_, "--truth", drive + "/gt", "--max-ate", "0.01"});
    EXPECT_EQ(evaluated.exit_code, 0) << evaluated.output;
  }
}

TEST_F(Slam6dProgram, LeavesNoTruthOfALongerDriveBefore) {
  const std::string drive = folder_.path() / "office";
  for (const std::string scans : {"3", "2"}) {
    ASSERT_EQ(
        RunSlam6d({"sim", "office", "--output", drive, "--scans", scans, "--every", "1"}).exit_code,
        0);
  }
  EXPECT_EQ(io::ReadPoses(drive).size(), 2U);
  EXPECT_EQ(io::ReadPoses(drive + "/gt").size(), 2U);
}

TEST_F(Slam6dProgram, DoesNotPutResultsBesideItsScans) {
  const std::string before = ReadFile(Scan(0));
  for (const std::string& input : {scans_.string(), Scan(0).string()}) {
    const Outcome outcome = RunSlam6d({"register", input, "--output", scans_, "--force"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("which is an input"), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(ReadFile(Scan(0)), before);
  EXPECT_FALSE(fs::exists(scans_ / "run.log"));
}

TEST_F(Slam6dProgram, TakesItsOwnConfiguration) {
  EXPECT_NE(RunSlam6d({"register", "--help"}).output.find("in YAML; see slam6d config"),
            std::string::npos);
  const Outcome dumped = RunSlam6d({"config", "--set", "slam.icp.metric=point-to-plane"});
  ASSERT_EQ(dumped.exit_code, 0) << dumped.errors;
  const fs::path file = folder_.path() / "mine.yaml";
  std::ofstream(file) << dumped.output;
  EXPECT_EQ(Register({"--config", file}).exit_code, 0);
  EXPECT_NE(ReadFile(results_ / "config.yaml").find("metric: point-to-plane"), std::string::npos);
}

}  // namespace
}  // namespace slam6d
