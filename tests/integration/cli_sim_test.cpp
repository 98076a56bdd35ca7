// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm sim` as its users run it.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class SimCommand : public ::testing::Test {
 protected:
  Outcome Simulate(const std::string& scenario, std::vector<std::string> more, const char* folder) {
    more.insert(more.begin(), {"sim", scenario, "--output", folder_.path() / folder});
    return RunProgram(more);
  }

  fs::path File(const char* folder, const char* name) const {
    return folder_.path() / folder / name;
  }

  TemporaryFolder folder_;
};

TEST_F(SimCommand, LeavesALogThatReadsBackWithTheTruth) {
  const Outcome outcome = Simulate("park", {"--duration", "20"}, "park");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("robot          21 scans"), std::string::npos) << outcome.output;
  const Trajectory truth = io::ReadTumFile(File("park", "robot.truth.tum"));
  ASSERT_EQ(truth.size(), 21U);
  EXPECT_EQ(io::ReadTumFile(File("park", "robot.odometry.tum")).size(), 21U);
  EXPECT_TRUE(ReadFile(File("park", "robot.png")).starts_with("\x89PNG"));

  const auto reader = io::OpenLog(File("park", "robot.log"), {});
  std::size_t scans = 0;
  std::size_t true_poses = 0;
  while (const std::optional<io::LogRecord> record = reader->Next()) {
    if (const auto* scan = std::get_if<io::ScanReading>(&*record)) {
      EXPECT_EQ(scan->scan.size(), 181U);
      EXPECT_EQ(scan->scan.stamp, truth[scans].stamp);
      EXPECT_TRUE(scan->T_odom_robot.has_value());
      ++scans;
    } else if (const auto* pose = std::get_if<io::TruePoseReading>(&*record)) {
      EXPECT_NEAR(pose->T_world_robot.x_m, truth[true_poses].T_map_robot.x_m, 1e-9);
      ++true_poses;
    }
  }
  EXPECT_EQ(scans, 21U);
  EXPECT_EQ(true_poses, 21U);
}

TEST_F(SimCommand, WritesNothingOutsideItsFolderAndOverNothingOfItsOwn) {
  for (const char* name : {"../outside", "run"}) {
    const Outcome outcome = Simulate(
        "park", {"--duration", "2", "--set", std::string("robots[0].name=") + name}, "named");
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.errors.find("robots[0].name: "), std::string::npos) << outcome.errors;
    EXPECT_FALSE(fs::exists(folder_.path() / "outside.log"));
    EXPECT_FALSE(fs::exists(folder_.path() / "named"));
  }
}

TEST_F(SimCommand, GivesTheSameForTheSameSeedOnly) {
  for (const char* folder : {"a", "b"}) Simulate("park", {"--duration", "10"}, folder);
  Simulate("park", {"--duration", "10", "--seed", "2"}, "c");
  EXPECT_EQ(ReadFile(File("a", "robot.log")), ReadFile(File("b", "robot.log")));
  EXPECT_NE(ReadFile(File("a", "robot.log")), ReadFile(File("c", "robot.log")));
}

TEST_F(SimCommand, KeepsTheSeedWhereOtherSettingsAreGiven) {
  Simulate("park", {"--seed", "2", "--duration", "3", "--set", "ground.everywhere=floor"}, "a");
  EXPECT_NE(ReadFile(File("a", "scenario.yaml")).find("seed: 2"), std::string::npos);
  EXPECT_NE(ReadFile(File("a", "scenario.yaml")).find("duration_s: 3"), std::string::npos);
}

TEST_F(SimCommand, CanBeRunAgainFromWhatItLeft) {
  Simulate("office", {"--duration", "5", "--set", "robots[0].laser.beams=91"}, "a");
  const Outcome outcome = Simulate(File("a", "scenario.yaml"), {}, "b");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(ReadFile(File("a", "robot.log")), ReadFile(File("b", "robot.log")));
}

TEST_F(SimCommand, LeavesALogForEveryRobot) {
  const Outcome outcome = Simulate("team", {"--duration", "2"}, "team");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* log : {"robot_1.log", "robot_2.log", "robot_3.log", "robot_4.log"}) {
    EXPECT_GT(fs::file_size(File("team", log)), 1000U);
  }
}

TEST_F(SimCommand, RefusesWhatItCannotRun) {
  const fs::path bad = folder_.path() / "bad.yaml";
  std::ofstream(bad) << "robots:\n  - laser: {beams: 0}\n  - mas_kg: 1\n";
  const Outcome outcome = Simulate(bad, {}, "bad");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("bad.yaml:2:20: robots[0].laser.beams: must be between"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("bad.yaml:3:5: robots[1].mas_kg: unknown option; did you mean"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder_.path() / "bad"));
  EXPECT_EQ(Simulate("no-such-place", {}, "none").exit_code, 2);
}

TEST_F(SimCommand, KeepsPaceWithRealTimeIfAsked) {
  const auto begin = std::chrono::steady_clock::now();
  Simulate("park", {"--duration", "10", "--speed", "20"}, "paced");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(450));
}

}  // namespace
}  // namespace qwsm::test
