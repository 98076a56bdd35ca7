// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm map` on a bag of several robots: they map as a team.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/metrics/trajectory_error.hpp"
#include "service/config/options_io.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/team_bag.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

/// What some robots measure, and a bag of it.
class RecordedTeam {
 public:
  RecordedTeam(const std::string& scenario,
               const std::vector<std::string>& settings,
               std::vector<std::string> robots)
      : robots_(std::move(robots)),
        readings_(ReadingsOf(
            config::LoadOptions<sim::ScenarioOptions>(
                {.file = QWSM_SOURCE_DIR "/configs/scenarios/" + scenario, .settings = settings}),
            robots_.size())) {
    WriteTeamBag(readings_, robots_, bag_);
  }

  const fs::path& folder() const { return folder_.path(); }
  const std::vector<std::string>& robots() const { return robots_; }

  Outcome Map(const fs::path& results, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map", bag_, "--output", results};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  }

  /// The pairs of answered and true poses of a robot.
  std::vector<PosePair> PairsOf(std::size_t robot, const fs::path& trajectory) const {
    std::vector<PosePair> pairs;
    for (const StampedPose2& pose : io::ReadTumFile(trajectory)) {
      const auto truth = std::ranges::find_if(readings_, [&](const sim::Reading& reading) {
        return reading.robot == robot && reading.scan.stamp >= pose.stamp - kRounding;
      });
      pairs.push_back({.stamp = pose.stamp,
                       .T_ref_robot = truth->T_world_robot,
                       .T_map_robot = pose.T_map_robot});
    }
    return pairs;
  }

  /// The error of the paths of all robots, in one frame.
  double ErrorOf_m(const fs::path& results, const std::string& trajectory) const {
    std::vector<PosePair> pairs;
    for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
      std::ranges::move(PairsOf(robot, results / robots_[robot] / trajectory),
                        std::back_inserter(pairs));
    }
    EXPECT_GT(pairs.size(), 0.9 * static_cast<double>(readings_.size()));
    return AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse;
  }

 private:
  static constexpr std::chrono::nanoseconds kRounding = std::chrono::milliseconds(1);

  TemporaryFolder folder_;
  fs::path bag_ = folder_.path() / "team.mcap";
  std::vector<std::string> robots_;
  std::vector<sim::Reading> readings_;
};

/// Two robots in an office.
class TeamBag : public testing::Test {
 protected:
  Outcome Map(const fs::path& results, const std::vector<std::string>& more = {}) const {
    return team_.Map(results, more);
  }
  double ErrorOf_m(const fs::path& results, const std::string& trajectory) const {
    return team_.ErrorOf_m(results, trajectory);
  }

  RecordedTeam team_{"team.yaml", {"duration_s=100"}, {"robot_1", "robot_2"}};
  const fs::path& folder_ = team_.folder();
  const std::vector<std::string>& robots_ = team_.robots();
};

TEST_F(TeamBag, IsMappedIntoOneMapTheSameEachTime) {
  const fs::path first = folder_ / "first";
  const Outcome mapped = Map(first);
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_NE(mapped.output.find("robot_2"), std::string::npos) << mapped.output;
  for (const char* name : {"map.png", "map.yaml", "map.qwsm"}) {
    EXPECT_TRUE(fs::exists(first / name)) << name;
  }
  EXPECT_LT(ErrorOf_m(first, "trajectory.tum"), 0.01);
  EXPECT_LT(ErrorOf_m(first, "truth.tum"), 1e-5);  // All in one frame.

  const fs::path second = folder_ / "second";
  ASSERT_EQ(Map(second, {"--save-map", folder_ / "team.qwsm"}).exit_code, 0);
  for (const std::string& robot : robots_) {
    SCOPED_TRACE(robot);
    for (const char* name : {"trajectory.tum", "trajectory_live.tum", "loops.csv", "graph.g2o"}) {
      const std::string content = ReadFile(first / robot / name);
      EXPECT_GT(content.size(), 1000U) << name;
      EXPECT_TRUE(content == ReadFile(second / robot / name)) << name;
    }
  }
  EXPECT_TRUE(ReadFile(folder_ / "team.qwsm") == ReadFile(second / "map.qwsm"));
}

// One graph for all: each robot's folder has it, with the loops between robots.
TEST_F(TeamBag, IsCorrectedByOneGraph) {
  const fs::path results = folder_ / "corrected";
  ASSERT_EQ(Map(results, {"--no-pictures"}).exit_code, 0);
  EXPECT_TRUE(ReadFile(results / robots_[0] / "graph.g2o") ==
              ReadFile(results / robots_[1] / "graph.g2o"));
  for (const std::string& robot : robots_) {
    SCOPED_TRACE(robot);
    EXPECT_FALSE(ReadFile(results / robot / "trajectory.tum") ==
                 ReadFile(results / robot / "trajectory_live.tum"));
    EXPECT_NE(ReadFile(results / robot / "scans.csv").find("corrected_x_m"), std::string::npos);
  }
  EXPECT_LE(ErrorOf_m(results, "trajectory.tum"), 1.02 * ErrorOf_m(results, "trajectory_live.tum"));
}

TEST_F(TeamBag, IsMappedAsAnsweredWhereNothingIsToBeCorrected) {
  const fs::path results = folder_ / "answered";
  ASSERT_EQ(Map(results, {"--no-pictures", "--set", "graph.enabled=false"}).exit_code, 0);
  for (const std::string& robot : robots_) {
    EXPECT_TRUE(fs::exists(results / robot / "trajectory.tum")) << robot;
    EXPECT_FALSE(fs::exists(results / robot / "trajectory_live.tum")) << robot;
  }
  EXPECT_LT(ErrorOf_m(results, "trajectory.tum"), 0.02);
}

TEST_F(TeamBag, GivesOneRobotWhereItIsAskedFor) {
  const fs::path results = folder_ / "one";
  ASSERT_EQ(Map(results, {"--robot", "robot_2"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(results / "trajectory.tum"));
  const Outcome refused = Map(results, {"--force", "--bag"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(Map(results, {"--force", "--view"}).exit_code, 2);
  EXPECT_NE(
      refused.errors.find("holds several robots: /robot_1, /robot_2; choose one with --robot"),
      std::string::npos)
      << refused.errors;
}

TEST(TeamBagOfABrokenLaser, IsMappedWithoutItsRobot) {
  std::vector<sim::Reading> readings = ReadingsOf(
      config::LoadOptions<sim::ScenarioOptions>(
          {.file = QWSM_SOURCE_DIR "/configs/scenarios/team.yaml", .settings = {"duration_s=20"}}),
      2);
  for (sim::Reading& reading : readings) {
    if (reading.robot == 1) reading.scan.geometry.range_max_m = 0.0F;
  }
  const TemporaryFolder folder;
  const fs::path bag = folder.path() / "team.mcap";
  WriteTeamBag(readings, std::vector<std::string>{"robot_1", "robot_2"}, bag);
  const Outcome mapped = RunProgram({"map", bag, "-o", folder.path() / "results"});
  EXPECT_EQ(mapped.exit_code, 1);
  EXPECT_NE(mapped.errors.find("robot_2: is not mapped: there is no scan"), std::string::npos)
      << mapped.errors;
  EXPECT_FALSE(io::ReadTumFile(folder.path() / "results/robot_1/trajectory.tum").empty());
}

// A laser that is covered, or has nothing in reach: its scans are whole, and none has a reading.
TEST(TeamBagOfABlindRobot, IsOneMapOfThoseThatSee) {
  std::vector<sim::Reading> readings = ReadingsOf(
      config::LoadOptions<sim::ScenarioOptions>(
          {.file = QWSM_SOURCE_DIR "/configs/scenarios/team.yaml", .settings = {"duration_s=100"}}),
      2);
  std::vector<sim::Reading> all;
  for (const sim::Reading& reading : readings) {
    sim::Reading blind = reading;
    std::ranges::fill(blind.scan.ranges_m, std::numeric_limits<float>::infinity());
    blind.robot = 0;
    if (reading.robot == 0) all.push_back(blind);
    all.push_back(reading);
    all.back().robot += 1;
  }
  const TemporaryFolder folder;
  const fs::path bag = folder.path() / "team.mcap";
  const std::vector<std::string> robots{"robot_0", "robot_1", "robot_2"};
  WriteTeamBag(all, robots, bag);
  const fs::path results = folder.path() / "results";
  const Outcome mapped = RunProgram({"map", bag, "-o", results, "--no-pictures"});
  EXPECT_EQ(mapped.exit_code, 1);
  EXPECT_NE(mapped.errors.find("robot_0: has seen nothing"), std::string::npos) << mapped.errors;
  EXPECT_EQ(mapped.errors.find("robot_1: "), std::string::npos) << mapped.errors;
  EXPECT_EQ(mapped.errors.find("robot_2: "), std::string::npos) << mapped.errors;
  EXPECT_TRUE(ReadFile(results / "robot_1/graph.g2o") == ReadFile(results / "robot_2/graph.g2o"));
  EXPECT_TRUE(fs::exists(results / "map.yaml"));
}

// Along a corridor that repeats itself, whose robots see each other: each would be held back by the
// one ahead, and found a leg of the corridor off.
TEST(TeamBagOfACorridor, IsMappedWithoutWhoComesAlong) {
  const RecordedTeam team(
      "team_corridor.yaml", {"duration_s=90", "seed=4"}, {"robot_1", "robot_2", "robot_3"});
  const fs::path all = team.folder() / "all";
  const Outcome mapped = team.Map(all, {"--no-pictures"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_LT(team.ErrorOf_m(all, "trajectory.tum"), 0.2);
  const fs::path one = team.folder() / "one";
  ASSERT_EQ(team.Map(one, {"--no-pictures", "--robot", "robot_1"}).exit_code, 0);
  const std::vector<PosePair> pairs = team.PairsOf(0, one / "trajectory.tum");
  EXPECT_LT(AbsoluteTrajectoryError(pairs, AlignUmeyama(pairs)).rmse, 0.1);
}

}  // namespace
}  // namespace qwsm::test
