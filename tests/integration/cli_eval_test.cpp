// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm eval`, `qwsm convert` and `qwsm config` as their users run them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>

#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

constexpr int kScansJudged = 30;

/// A trajectory that is 3 cm to the left of the truth, and a truth.
class EvalCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    Trajectory truth;
    Trajectory shifted;
    for (int scan = 0; scan < kScansJudged; ++scan) {
      const Timestamp stamp = std::chrono::milliseconds(100 * scan);
      Pose2 T_map_robot = PoseInRoom(scan);
      truth.push_back({stamp, T_map_robot});
      T_map_robot.y_m += 0.03;
      shifted.push_back({stamp, T_map_robot});
    }
    io::WriteTumFile(truth_, truth);
    io::WriteTumFile(shifted_, shifted);
    const Pose2 relation = truth[0].T_map_robot.Inverse() * truth[20].T_map_robot;
    std::ofstream(relations_) << "0 2.0 " << relation.x_m + 0.5 << ' ' << relation.y_m << " 0 0 0 "
                              << relation.theta_rad << '\n';
  }

  TemporaryFolder folder_;
  fs::path truth_ = folder_.path() / "truth.tum";
  fs::path shifted_ = folder_.path() / "shifted.tum";
  fs::path relations_ = folder_.path() / "true.relations";
};

TEST_F(EvalCommand, TellsErrorsWithUnits) {
  const Outcome outcome = RunProgram({"eval", shifted_, "--truth", truth_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("ate              m        30  0.0300"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("rpe translation  m        29  0.0000"), std::string::npos)
      << outcome.output;
}

TEST_F(EvalCommand, AlignsWhereAsked) {
  const Outcome outcome = RunProgram({"eval", shifted_, "--truth", truth_, "--align", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("\"ate\""), std::string::npos);
  EXPECT_EQ(
      RunProgram({"eval", shifted_, "--truth", truth_, "--align", "--max-ate", "0.001"}).exit_code,
      0);
}

TEST_F(EvalCommand, TellsOfPosesWithoutTruth) {
  EXPECT_EQ(RunProgram({"eval", shifted_, "--truth", truth_}).output.find("skipped"),
            std::string::npos);
  // Of which the first alone, at 0, is where one of the truth is.
  const fs::path milliseconds = folder_.path() / "milliseconds.tum";
  Trajectory truth = io::ReadTumFile(truth_);
  for (StampedPose2& pose : truth) pose.stamp *= 1000;
  io::WriteTumFile(milliseconds, truth);
  const Outcome outcome = RunProgram({"eval", shifted_, "--truth", milliseconds});
  EXPECT_NE(outcome.output.find("29 poses skipped"), std::string::npos) << outcome.output;
}

// Two runs in one file, or stamps that were rounded: some poses are not judged, or by another
// truth.
TEST_F(EvalCommand, TellsOfPosesThatShareAStamp) {
  const fs::path twice = folder_.path() / "twice.tum";
  const auto write = [&](const fs::path& first, const fs::path& second) {
    std::ofstream(twice) << ReadFile(first) << ReadFile(second);
  };
  write(truth_, shifted_);
  const std::string told = twice.string() + ": 30 poses have the stamp of another one, that of 0";
  const Outcome estimate = RunProgram({"eval", twice, "--truth", truth_});
  EXPECT_EQ(estimate.exit_code, 0) << estimate.errors;
  EXPECT_NE(estimate.output.find(told), std::string::npos) << estimate.output;
  EXPECT_NE(estimate.output.find("ate              m        30  0.0000"), std::string::npos)
      << estimate.output;  // The first of each stamp, as evo does it.
  EXPECT_NE(RunProgram({"eval", twice, "--relations", relations_}).output.find(told),
            std::string::npos);
  const Outcome truth = RunProgram({"eval", truth_, shifted_, "--truth", twice});
  EXPECT_NE(truth.output.find(told), std::string::npos) << truth.output;
  EXPECT_EQ(truth.output.find(told), truth.output.rfind(told)) << truth.output;
  const Outcome json = RunProgram({"eval", shifted_, "--truth", twice, "--json"});
  EXPECT_NE(json.output.find("\"poses_repeated\": 0"), std::string::npos) << json.output;
  EXPECT_NE(json.output.find("\"truth_repeated\": 30"), std::string::npos) << json.output;
  // As of two lasers that scan at the same time, whose truth is the same.
  write(truth_, truth_);
  EXPECT_EQ(RunProgram({"eval", shifted_, "--truth", twice}).output.find("stamp of another"),
            std::string::npos);
}

TEST_F(EvalCommand, FailsAboveItsBounds) {
  EXPECT_EQ(RunProgram({"eval", shifted_, "--truth", truth_, "--max-ate", "0.0301"}).exit_code, 0);
  const Outcome outcome = RunProgram({"eval", shifted_, "--truth", truth_, "--max-ate", "0.0299"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.errors,
            "qwsm: " + shifted_.string() + ": ate rmse [m]: 0.03 is above 0.0299\n");
}

TEST_F(EvalCommand, MeasuresRelationsOfSeveralTrajectories) {
  const Outcome outcome = RunProgram({"eval", truth_, shifted_, "--relations", relations_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  std::size_t at = 0;
  for (int row = 0; row < 2; ++row) {
    at = outcome.output.find("relations translation  m         1  0.5000", at + 1);
    EXPECT_NE(at, std::string::npos) << outcome.output;
  }
  EXPECT_EQ(
      RunProgram({"eval", truth_, "--relations", relations_, "--max-relations", "0.4"}).exit_code,
      1);
}

TEST_F(EvalCommand, RefusesWhatMakesNoSense) {
  EXPECT_EQ(RunProgram({"eval", shifted_}).exit_code, 2);
  EXPECT_EQ(RunProgram({"eval", shifted_, "--truth", truth_, "--max-relations", "1"}).exit_code, 2);
  std::ofstream(folder_.path() / "poem") << "no trajectory at all\n";
  EXPECT_EQ(RunProgram({"eval", folder_.path() / "poem", "--truth", truth_}).exit_code, 2);
  const Outcome outcome = RunProgram({"eval", folder_.path() / "none.tum", "--truth", truth_});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("none.tum"), std::string::npos) << outcome.errors;
}

TEST(ConvertCommand, GivesALogThatMapsTheSame) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  const fs::path converted = folder.path() / "converted.log";
  WriteRoomLog(log, kScansJudged);
  ASSERT_EQ(RunProgram({"convert", log, "-o", converted}).exit_code, 0);
  RunProgram({"map", log, "-o", folder.path() / "a"});
  RunProgram({"map", converted, "-o", folder.path() / "b"});
  const std::string trajectory = ReadFile(folder.path() / "a/trajectory.tum");
  EXPECT_FALSE(trajectory.empty());
  EXPECT_EQ(trajectory, ReadFile(folder.path() / "b/trajectory.tum"));
}

TEST(ConvertCommand, TakesOdometryOut) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  const Outcome outcome = RunProgram({"convert", log, "--to", "odometry"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(outcome.output.starts_with("1000.000000000 0 0 0 0 0 0 1\n1000.1")) << outcome.output;
}

TEST(ConvertCommand, LeavesNothingOfWhatALogHasNot) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  const fs::path empty = folder.path() / "empty.log";
  std::ofstream(empty) << "PARAM robot_length 0.5 0 host 0\n";
  const fs::path output = folder.path() / "output";
  for (const auto& [input, form, why] :
       {std::tuple{log, "truth", "tells no true pose"},
        std::tuple{empty, "odometry", "holds no scan with odometry"},
        std::tuple{empty, "carmen", "holds neither scans nor odometry"},
        std::tuple{empty, "mcap", "holds neither scans nor odometry"}}) {
    const Outcome outcome = RunProgram({"convert", input, "--to", form, "-o", output});
    EXPECT_EQ(outcome.exit_code, 2) << form;
    EXPECT_NE(outcome.errors.find(why), std::string::npos) << outcome.errors;
    EXPECT_FALSE(fs::exists(output)) << form;
  }
  const Outcome outcome = RunProgram({"convert", log, "-o", folder.path() / "room.bag"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("bags of ROS 1"), std::string::npos) << outcome.errors;
}

TEST(ConvertCommand, KeepsWhatCameBeforeAFault) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  std::ofstream(log, std::ios::app) << "FLASER 3 1.0 nonsense\n";
  const fs::path output = folder.path() / "odometry.tum";
  const Outcome outcome =
      RunProgram({"convert", log, "--to", "odometry", "-o", output, "--set", "log.strict=true"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("room.log:4: "), std::string::npos) << outcome.errors;
  const std::string kept = ReadFile(output);
  EXPECT_EQ(std::ranges::count(kept, '\n'), 3);
}

TEST(ConvertCommand, TurnsMirroredScansAsMapDoes) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  const auto convert = [&](const fs::path& from, const std::string& to, const char* mirrored) {
    const std::string setting = std::string("log.mirrored=") + mirrored;
    RunProgram({"convert", from, "-o", folder.path() / to, "--set", setting});
    return ReadFile(folder.path() / to);
  };
  const std::string as_it_is = convert(log, "as_it_is.log", "false");
  const std::string mirrored = convert(log, "mirrored.log", "true");
  EXPECT_FALSE(mirrored.empty());
  EXPECT_NE(mirrored, as_it_is);
  EXPECT_EQ(convert(folder.path() / "mirrored.log", "back.log", "true"), as_it_is);
}

TEST(ConvertCommand, ReplacesNoInput) {
  const TemporaryFolder folder;
  const fs::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  const fs::path bag = folder.path() / "bag";
  ASSERT_EQ(RunProgram({"convert", log, "-o", bag}).exit_code, 0);
  const std::string in_bag = ReadFile(bag / "bag_0.mcap");
  const auto expect_refusal = [](const fs::path& input, const fs::path& output) {
    for (const char* form : {"mcap", "odometry"}) {
      const Outcome outcome = RunProgram({"convert", input, "-o", output, "--to", form});
      EXPECT_EQ(outcome.exit_code, 3) << input << " to " << output;
      EXPECT_NE(outcome.errors.find("which is an input"), std::string::npos) << outcome.errors;
    }
  };
  fs::create_symlink(log, folder.path() / "link.log");
  expect_refusal(log, log);
  expect_refusal(folder.path() / "link.log", log);
  expect_refusal(bag, bag);
  expect_refusal(bag, bag / "bag_0.mcap");
  expect_refusal(bag / "bag_0.mcap", bag);
  EXPECT_EQ(ReadFile(bag / "bag_0.mcap"), in_bag);
}

TEST(ConfigCommand, DumpsWhatItAccepts) {
  const TemporaryFolder folder;
  const Outcome dump = RunProgram({"config", "dump", "--set", "mapper.relevant_rotation_deg=7.3"});
  EXPECT_EQ(dump.exit_code, 0) << dump.errors;
  EXPECT_NE(dump.output.find("relevant_rotation_deg: 7.3\n"), std::string::npos);
  const fs::path file = folder.path() / "robot.yaml";
  std::ofstream(file) << dump.output;
  EXPECT_EQ(RunProgram({"config", "check", file}).exit_code, 0);
  EXPECT_EQ(RunProgram({"config", "dump", "--config", file}).output, dump.output);
}

TEST(ConfigCommand, TakesBackATextThatAFileGives) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "robot.yaml";
  std::ofstream(file) << "log: {scan: /front/scan}\n";
  const Outcome dump = RunProgram({"config", "dump", "--config", file, "--set", "log.scan="});
  EXPECT_EQ(dump.exit_code, 0) << dump.errors;
  EXPECT_EQ(dump.output, RunProgram({"config", "dump"}).output);
}

TEST(ConfigCommand, ChecksAllFiles) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.yaml") << "log: {strict: 1}\n";
  std::ofstream(folder.path() / "b.yaml") << "maper: {}\n";
  const Outcome outcome =
      RunProgram({"config", "check", folder.path() / "a.yaml", folder.path() / "b.yaml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("a.yaml:1:15: log.strict: expected true or false"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("b.yaml:1:1: maper: unknown option; did you mean 'mapper'?"),
            std::string::npos)
      << outcome.errors;
}

TEST(ConfigCommand, DescribesOptionsWithUnits) {
  const Outcome outcome = RunProgram({"config", "describe"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.output.find("mapper.relevant_translation_m"), std::string::npos);
  EXPECT_TRUE(outcome.output.starts_with("option ")) << outcome.output.substr(0, 80);
}

}  // namespace
}  // namespace qwsm::test
