// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm map` as its users run it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

constexpr int kScansMapped = 40;

std::size_t CountLines(const fs::path& file) {
  const std::string text = ReadFile(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class MapCommand : public ::testing::Test {
 protected:
  void SetUp() override { WriteRoomLog(log_, kScansMapped); }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path results_ = folder_.path() / "results";
};

TEST_F(MapCommand, LeavesAllResults) {
  const Outcome outcome = RunProgram({"map", log_, "--output", results_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("scans          40"), std::string::npos) << outcome.output;
  EXPECT_EQ(CountLines(results_ / "trajectory.tum"), kScansMapped);
  EXPECT_EQ(CountLines(results_ / "scans.csv"), kScansMapped + 1);
  EXPECT_NE(ReadFile(results_ / "metrics.json").find("\"scans\": 40"), std::string::npos);
  EXPECT_NE(ReadFile(results_ / "config.yaml").find("matcher: q-wsm"), std::string::npos);
  EXPECT_NE(ReadFile(results_ / "run.log").find("40 scans"), std::string::npos);
  for (const char* picture : {"map.png", "trajectory.png", "residual.png"}) {
    EXPECT_TRUE(ReadFile(results_ / picture).starts_with("\x89PNG")) << picture;
  }
  EXPECT_TRUE(ReadFile(results_ / "map.pgm").starts_with("P5"));
  EXPECT_NE(ReadFile(results_ / "map.yaml").find("map.pgm"), std::string::npos);
  for (const fs::directory_entry& entry : fs::directory_iterator(results_)) {
    EXPECT_NE(entry.path().extension(), ".part");
  }
}

TEST_F(MapCommand, FollowsTheRobot) {
  RunProgram({"map", log_, "--output", results_});
  const Trajectory trajectory = io::ReadTumFile(results_ / "trajectory.tum");
  ASSERT_EQ(trajectory.size(), kScansMapped);
  const Pose2 T_start_end = PoseInRoom(0).Inverse() * PoseInRoom(kScansMapped - 1);
  const Pose2 T_map_end = trajectory.back().T_map_robot;
  EXPECT_NEAR(T_map_end.x_m, T_start_end.x_m, 0.02);
  EXPECT_NEAR(T_map_end.y_m, T_start_end.y_m, 0.02);
  EXPECT_NEAR(NormalizeAngle(T_map_end.theta_rad - T_start_end.theta_rad), 0.0, 0.01);
}

TEST_F(MapCommand, GivesTheSameFromABag) {
  RunProgram({"map", log_, "--output", results_});
  for (const char* name : {"room.mcap", "room.db3", "room"}) {
    SCOPED_TRACE(name);
    const fs::path bag = folder_.path() / name;
    const Outcome converted = RunProgram({"convert", log_, "-o", bag});
    EXPECT_EQ(converted.exit_code, 0) << converted.errors;
    const fs::path mapped = folder_.path() / (std::string("of_") + name);
    const Outcome outcome = RunProgram({"map", bag, "--output", mapped});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors.find("room"), std::string::npos) << "nothing is to be told";
    EXPECT_EQ(ReadFile(mapped / "trajectory.tum"), ReadFile(results_ / "trajectory.tum"));
  }
}

TEST_F(MapCommand, LeavesItsAnswersAsABag) {
  RunProgram({"map", log_, "--output", results_, "--bag"});
  EXPECT_TRUE(ReadFile(results_ / "answers.mcap").starts_with("\x89MCAP0\r\n"));
}

TEST_F(MapCommand, GivesTheSameFromAPipe) {
  RunProgram({"map", log_, "--output", results_});
  const fs::path piped = folder_.path() / "piped";
  const Outcome outcome = Program({"map", "-", "--output", piped}, {.input = log_}).Wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(ReadFile(piped / "trajectory.tum"), ReadFile(results_ / "trajectory.tum"));
}

TEST_F(MapCommand, RunsAgainFromItsOwnConfiguration) {
  RunProgram({"map", log_, "--output", results_, "--set", "mapper.relevant_rotation_deg=7.3"});
  const fs::path again = folder_.path() / "again";
  const Outcome outcome =
      RunProgram({"map", log_, "-o", again, "--config", results_ / "config.yaml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(ReadFile(again / "config.yaml"), ReadFile(results_ / "config.yaml"));
  EXPECT_EQ(ReadFile(again / "trajectory.tum"), ReadFile(results_ / "trajectory.tum"));
}

TEST_F(MapCommand, WritesJsonLinesForPipes) {
  const Outcome outcome = RunProgram({"map", log_, "--output", results_, "--json"});
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), kScansMapped);
  EXPECT_TRUE(outcome.output.starts_with("{\"stamp_s\":1000.0,"));
}

TEST_F(MapCommand, ReplacesItsOwnResultsOnly) {
  RunProgram({"map", log_, "--output", results_});
  EXPECT_EQ(RunProgram({"map", log_, "--output", results_}).exit_code, 0);
  const fs::path foreign = folder_.path() / "thesis";
  fs::create_directory(foreign);
  std::ofstream(foreign / "chapter1.tex") << "Introduction";
  const Outcome refused = RunProgram({"map", log_, "--output", foreign});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.errors.find("--force"), std::string::npos) << refused.errors;
  EXPECT_EQ(RunProgram({"map", log_, "--output", foreign, "--force"}).exit_code, 0);
  EXPECT_EQ(ReadFile(foreign / "chapter1.tex"), "Introduction");
  EXPECT_EQ(CountLines(foreign / "trajectory.tum"), kScansMapped);
}

TEST_F(MapCommand, DoesNotPutResultsBesideItsInput) {
  // An earlier result, whose files are removed before the next one: the log would be lost.
  ASSERT_EQ(RunProgram({"map", log_, "--output", results_}).exit_code, 0);
  const fs::path log = results_ / "room.log";
  fs::copy_file(log_, log);
  for (const char* option : {"--quiet", "--force", "--dry-run"}) {
    const Outcome outcome = RunProgram({"map", log, "--output", results_, option});
    EXPECT_EQ(outcome.exit_code, 3) << option;
    EXPECT_EQ(outcome.errors,
              "qwsm: " + results_.string() + ": holds " + log.string() +
                  ", which is an input; name another folder for the results\n");
  }
  EXPECT_EQ(ReadFile(log), ReadFile(log_));
  EXPECT_EQ(RunProgram({"map", log, "--output", results_ / "again"}).exit_code, 0);
}

TEST_F(MapCommand, SavesNoMapOverAnythingElse) {
  const std::string log = ReadFile(log_);
  const fs::path link = folder_.path() / "link.qwsm";
  fs::create_symlink(log_, link);
  const fs::path notes = folder_.path() / "notes.txt";
  std::ofstream(notes) << "Monday";
  const std::array<std::pair<fs::path, const char*>, 6> refusals{{
      {log_, "would replace"},
      {link, "would replace"},
      {notes, "is no map of qwsm"},
      {folder_.path(), "is a folder"},
      {folder_.path() / "missing" / "a.qwsm", "No such file or directory"},
      {results_ / "missing" / "a.qwsm", "No such file or directory"},
  }};
  for (const auto& [map, why] : refusals) {
    for (const char* option : {"--dry-run", "--quiet"}) {
      const Outcome outcome = RunProgram({"map", log_, "-o", results_, "--save-map", map, option});
      EXPECT_EQ(outcome.exit_code, 3) << map;
      EXPECT_NE(outcome.errors.find(why), std::string::npos) << outcome.errors;
    }
  }
  EXPECT_FALSE(fs::exists(results_));
  EXPECT_EQ(ReadFile(log_), log);
  EXPECT_EQ(ReadFile(notes), "Monday");
  const fs::path map = results_ / "room.qwsm";
  for (int i = 0; i < 2; ++i) {  // In a folder to be created, and over itself.
    EXPECT_EQ(RunProgram({"map", log_, "-o", results_, "--save-map", map}).exit_code, 0);
  }
  EXPECT_TRUE(fs::exists(map));
}

TEST_F(MapCommand, SavesAMapAmongResultsThatAreNamedFromWhereItRuns) {
  const fs::path elsewhere = fs::current_path();
  fs::current_path(folder_.path());
  const Outcome outcome =
      RunProgram({"map", log_, "-o", "new/results", "--save-map", "new/results/room.qwsm"});
  fs::current_path(elsewhere);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder_.path() / "new/results/room.qwsm"));
}

TEST_F(MapCommand, DoesNothingWhenDry) {
  const Outcome outcome = RunProgram({"map", log_, "--output", results_, "--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "would map " + log_.string() + "\ninto " + results_.string() + "\n");
  EXPECT_FALSE(fs::exists(results_));
}

TEST_F(MapCommand, KeepsWhatCameBeforeAFault) {
  std::ofstream(log_, std::ios::app) << "FLASER 3 1.0 nonsense\n";
  const Outcome outcome =
      RunProgram({"map", log_, "--output", results_, "--set", "log.strict=true"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("room.log:41: "), std::string::npos) << outcome.errors;
  EXPECT_EQ(CountLines(results_ / "trajectory.tum"), kScansMapped);
  EXPECT_EQ(RunProgram({"map", log_, "--output", results_}).exit_code, 0)
      << "skipped when not strict";
}

TEST_F(MapCommand, SaysThatTheDiskIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  fs::create_directory(results_);
  fs::create_symlink("/dev/full", results_ / "scans.csv.part");
  const Outcome outcome = RunProgram({"map", log_, "--output", results_, "--force"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.errors,
            "qwsm: " + (results_ / "scans.csv").string() +
                ": cannot be written: No space left on device\n");
}

/// Runs that are interrupted while somebody reads what they print, and so cannot end before.
class InterruptedMapCommand : public MapCommand {
 protected:
  void SetUp() override {
    WriteRoomLog(log_, 1000);
    ASSERT_EQ(mkfifo(pipe_.c_str(), 0600), 0);
  }

  fs::path pipe_ = folder_.path() / "pipe";
};

TEST_F(InterruptedMapCommand, WritesAllResultsOfWhatItDid) {
  Program program({"map", log_, "--output", results_, "--json"}, {.output = pipe_});
  std::ifstream lines(pipe_);
  std::string line;
  std::getline(lines, line);
  program.Signal(SIGINT);
  std::size_t count = 1;
  while (std::getline(lines, line)) ++count;
  const Outcome outcome = program.Wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  EXPECT_LT(count, 1000U);
  EXPECT_EQ(CountLines(results_ / "trajectory.tum"), count);
  EXPECT_EQ(CountLines(results_ / "scans.csv"), count + 1);
  EXPECT_TRUE(fs::exists(results_ / "metrics.json"));
  EXPECT_TRUE(fs::exists(results_ / "map.png"));
}

TEST_F(InterruptedMapCommand, WritesAllResultsAfterTheLastScanToo) {
  // Somebody reads the corrected path while it is written, which is when he interrupts.
  fs::create_directory(results_);
  fs::create_symlink(pipe_, results_ / "trajectory.tum.part");
  Program program({"map", log_, "--output", results_, "--force"});
  std::ifstream path(pipe_);
  program.Signal(SIGINT);
  std::size_t count = 0;
  for (std::string line; std::getline(path, line);) ++count;
  const Outcome outcome = program.Wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  EXPECT_EQ(count, 1000U);
  EXPECT_EQ(CountLines(results_ / "scans.csv"), count + 1);
  EXPECT_TRUE(fs::exists(results_ / "metrics.json"));
  EXPECT_TRUE(fs::exists(results_ / "map.png"));
}

TEST_F(InterruptedMapCommand, GoesOnWhereNobodyReadsItsLinesAnyMore) {
  Program program({"map", log_, "--output", results_, "--json"}, {.output = pipe_});
  {
    std::ifstream lines(pipe_);
    std::string line;
    std::getline(lines, line);
  }
  const Outcome outcome = program.Wait();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(CountLines(results_ / "trajectory.tum"), 1000U);
}

TEST_F(InterruptedMapCommand, QuitsWhenInterruptedTwice) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "ThreadSanitizer holds signals back while a program waits for a file to open";
#endif
  // Nobody reads the path, so that the results cannot be finished.
  fs::create_directory(results_);
  ASSERT_EQ(mkfifo((results_ / "trajectory.tum.part").c_str(), 0600), 0);
  Program program({"map", log_, "--output", results_, "--force", "--json"}, {.output = pipe_});
  std::ifstream lines(pipe_);
  std::string line;
  std::getline(lines, line);
  while (!program.HasEnded()) {
    program.Signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Outcome outcome = program.Wait();
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_NE(outcome.errors.find("quit without writing results"), std::string::npos);
  EXPECT_FALSE(fs::exists(results_ / "trajectory.tum"));
}

}  // namespace
}  // namespace qwsm::test
