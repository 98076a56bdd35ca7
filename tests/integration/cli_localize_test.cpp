// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm localize` as its users run it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "service/io/maps/ros_map_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

constexpr int kScansLocalized = 60;
constexpr int kFirst = 20;  // Where the second drive begins.

class LocalizeCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteRoomLog(log_, kScansLocalized);
    const Outcome outcome =
        RunProgram({"map", log_, "-o", folder_.path() / "mapped", "--save-map", map_});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    CutLog();
  }

  /// A log that begins in the middle of the drive.
  void CutLog() const {
    std::ifstream whole(log_);
    std::ofstream part(part_);
    std::string line;
    for (int scan = 0; std::getline(whole, line); ++scan) {
      if (scan >= kFirst) part << line << '\n';
    }
  }

  void ExpectOnThePath(double within_m = 0.03) const {
    const Trajectory mapped = io::ReadTumFile(folder_.path() / "mapped/trajectory.tum");
    const Trajectory localized = io::ReadTumFile(results_ / "trajectory.tum");
    ASSERT_EQ(localized.size(), static_cast<std::size_t>(kScansLocalized - kFirst));
    for (std::size_t i = 0; i < localized.size(); ++i) {
      const Pose2& expected = mapped[i + kFirst].T_map_robot;
      const Pose2 off = expected.Inverse() * localized[i].T_map_robot;
      EXPECT_LT(off.translation_m().norm(), within_m) << i;
      EXPECT_LT(std::abs(off.theta_rad), 0.02) << i;
    }
  }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path part_ = folder_.path() / "part.log";
  fs::path map_ = folder_.path() / "room.qwsm";
  fs::path results_ = folder_.path() / "localized";
};

TEST_F(LocalizeCommand, FindsOutWhereItStarts) {
  const Outcome outcome = RunProgram({"localize", "--map", map_, part_, "-o", results_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectOnThePath();
}

TEST_F(LocalizeCommand, TakesMapsOfOtherPrograms) {
  const fs::path map = folder_.path() / "mapped/map.yaml";
  const Outcome outcome = RunProgram({"localize", "--map", map, part_, "-o", results_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectOnThePath(0.05);
}

TEST_F(LocalizeCommand, SaysThatAGridHasNothingToLocalizeBy) {
  const fs::path map = folder_.path() / "empty.yaml";
  std::ofstream(map) << "image: empty.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.25\n";
  std::ofstream(folder_.path() / "empty.pgm", std::ios::binary) << "P5\n4 4\n255\n"
                                                                << std::string(16, '\xFE');
  const Outcome outcome = RunProgram({"localize", "--map", map, part_, "-o", results_});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("nothing to localize by"), std::string::npos) << outcome.errors;
}

TEST_F(LocalizeCommand, SaysWhenTheRobotWasNotFound) {
  std::ofstream(part_) << "FLASER 5 1 1 1 1 1 0 0 0 0 0 0 1.0 robot 1.0\n"
                          "FLASER 5 1 1 1 1 1 2 0 0 2 0 0 2.0 robot 2.0\n";
  const Outcome outcome = RunProgram({"localize", "--map", map_, part_, "-o", results_});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("the last 2 scans could not be placed"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("--at X Y DEG says where the robot starts"), std::string::npos);
  EXPECT_TRUE(io::ReadTumFile(results_ / "trajectory.tum").empty());

  const Outcome continued =
      RunProgram({"map", "--continue", map_, part_, "-o", folder_.path() / "continued"});
  EXPECT_EQ(continued.exit_code, 1);
  EXPECT_NE(continued.errors.find("the last 2 scans could not be placed"), std::string::npos);
  EXPECT_EQ(continued.errors.find("--at"), std::string::npos) << "which map does not know";
}

TEST_F(LocalizeCommand, SaysWhereTheRobotMayHaveStarted) {
  // Two such rooms, side by side.
  const OccupancyGrid room = io::ReadRosMap(folder_.path() / "mapped/map.yaml");
  OccupancyGrid rooms = room;
  rooms.width = 2 * room.width;
  rooms.cells.clear();
  for (int y = 0; y < rooms.height; ++y) {
    for (int x = 0; x < rooms.width; ++x) rooms.cells.push_back(room.At(x % room.width, y));
  }
  const fs::path map = folder_.path() / "rooms.yaml";
  io::WriteRosMap(map, rooms);
  const Outcome outcome = RunProgram({"localize", "--map", map, part_, "-o", results_});
  ASSERT_EQ(outcome.exit_code, 1) << outcome.output;
  const std::string before = "they may begin at ";
  const std::size_t at = outcome.errors.find(before);
  ASSERT_NE(at, std::string::npos) << outcome.errors;
  std::istringstream place(outcome.errors.substr(at + before.size()));
  std::string x_m;
  std::string y_m;
  std::string heading_deg;
  place >> x_m >> y_m >> heading_deg;
  const Outcome told =
      RunProgram({"localize", "--map", map, part_, "-o", results_, "--at", x_m, y_m, heading_deg});
  EXPECT_EQ(told.exit_code, 0) << told.errors;
  const Pose2 start = io::ReadTumFile(folder_.path() / "mapped/trajectory.tum")[kFirst].T_map_robot;
  const double off_m = std::abs(std::stod(x_m) - start.x_m);
  EXPECT_LT(std::min(off_m, std::abs(off_m - room.width * room.cell_m)), 0.1) << outcome.errors;
  EXPECT_NEAR(std::stod(y_m), start.y_m, 0.1);
}

TEST_F(LocalizeCommand, SaysWhatIsNotPlacedWhenItIsInterrupted) {
  std::ofstream log(part_);
  for (int scan = 0; scan < 2000; ++scan) {
    log << "FLASER 5 1 1 1 1 1 0 0 0 0 0 0 " << scan << ".0 robot " << scan << ".0\n";
  }
  log.close();
  const fs::path pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Program program({"localize", "--map", map_, part_, "-o", results_, "--json"}, {.output = pipe});
  std::ifstream lines(pipe);
  std::string line;
  std::getline(lines, line);
  program.Signal(SIGINT);
  while (std::getline(lines, line)) continue;
  const Outcome outcome = program.Wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.errors.find("scans are not placed: the robot was still looked for"),
            std::string::npos)
      << outcome.errors;
}

TEST_F(LocalizeCommand, StartsWhereItIsTold) {
  const Pose2 T_map_start = PoseInRoom(0).Inverse() * PoseInRoom(kFirst);
  const Outcome outcome = RunProgram({"localize",
                                      "--map",
                                      map_,
                                      part_,
                                      "-o",
                                      results_,
                                      "--at",
                                      std::to_string(T_map_start.x_m),
                                      std::to_string(T_map_start.y_m),
                                      std::to_string(RadiansToDegrees(T_map_start.theta_rad))});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectOnThePath();
}

TEST_F(LocalizeCommand, RefusesToStartNowhere) {
  for (const std::string number : {"nan", "inf", "-1e300", "3e7", "here"}) {
    const Outcome outcome =
        RunProgram({"localize", "--map", map_, part_, "-o", results_, "--at", number, "0", "0"});
    EXPECT_EQ(outcome.exit_code, 2) << number;
    EXPECT_NE(outcome.errors.find("--at: must be a number between -10000000 and 10000000, got '" +
                                  number + "'"),
              std::string::npos)
        << outcome.errors;
  }
}

TEST_F(LocalizeCommand, LeavesTheMapAsItIs) {
  const std::string before = ReadFile(map_);
  RunProgram({"localize", "--map", map_, part_, "-o", results_});
  EXPECT_EQ(ReadFile(map_), before);
  EXPECT_NE(ReadFile(results_ / "metrics.json").find("\"relevant\": 0"), std::string::npos);
}

TEST_F(LocalizeCommand, HasTheMapContinued) {
  const fs::path joint = folder_.path() / "joint.qwsm";
  const Outcome outcome =
      RunProgram({"map", part_, "--continue", map_, "--save-map", joint, "-o", results_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectOnThePath();
  EXPECT_GT(fs::file_size(joint), fs::file_size(map_));
  for (const char* left : {"trajectory_live.tum", "loops.csv", "graph.g2o"}) {
    EXPECT_TRUE(fs::exists(results_ / left)) << left;
  }
  const Outcome again = RunProgram({"localize", "--map", joint, part_, "-o", results_, "--force"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
}

TEST_F(LocalizeCommand, RefusesDamagedAndForeignMaps) {
  std::string bytes = ReadFile(map_);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(map_, std::ios::binary) << bytes;
  const Outcome damaged = RunProgram({"localize", "--map", map_, part_, "-o", results_});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_EQ(damaged.errors, "qwsm: " + map_.string() + ": is damaged: its checksum is wrong\n");
  const Outcome foreign = RunProgram({"localize", "--map", log_, part_, "-o", results_});
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_EQ(foreign.errors, "qwsm: " + log_.string() + ": is no map of qwsm\n");
  EXPECT_FALSE(fs::exists(results_));
}

}  // namespace
}  // namespace qwsm::test
