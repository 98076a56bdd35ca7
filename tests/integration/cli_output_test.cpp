// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Results that nobody gets are told: exit code 3 and one line, of every command.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class FullOutput : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    WriteRoomLog(log_, 10);
    Trajectory path;
    for (int scan = 0; scan < 10; ++scan) path.push_back({scan * kPeriod, PoseInRoom(scan)});
    io::WriteTumFile(path_, path);
  }

  static void ExpectTold(const std::string& program, const std::vector<std::string>& arguments) {
    SCOPED_TRACE(program + " " + arguments.front());
    const Outcome outcome = Program(arguments, {.output = "/dev/full", .program = program}).Wait();
    EXPECT_EQ(outcome.exit_code, 3);
    // The last line; before it a command may have told of its input.
    EXPECT_TRUE(outcome.errors.ends_with(
        program + ": standard output cannot be written: No space left on device\n"))
        << outcome.errors;
  }

  static constexpr std::chrono::milliseconds kPeriod{100};
  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path path_ = folder_.path() / "path.tum";
  fs::path results_ = folder_.path() / "results";
};

TEST_F(FullOutput, IsToldByQwsm) {
  const std::vector<std::vector<std::string>> commands{
      {"--help"},
      {"--version"},
      {"map", "--help"},
      {"map", log_, "-o", results_},
      {"map", log_, "-o", results_, "--json"},
      {"map", log_, "-o", results_, "--dry-run"},
      {"compare", log_, "-o", results_},
      {"eval", path_, "--truth", path_},
      {"eval", path_, "--truth", path_, "--json"},
      {"convert", log_},
      {"sim", "park", "--duration", "2", "-o", results_},
      {"experiment", "park", "--duration", "5", "--seeds", "1", "-o", results_},
      {"config", "dump"},
      {"config", "describe"}};
  for (const std::vector<std::string>& command : commands) ExpectTold("qwsm", command);
}

TEST_F(FullOutput, IsToldBySlam6d) {
  const std::string scans = folder_.path() / "scans";
  ASSERT_EQ(Program({"sim", "office", "--scans", "2", "--set", "sim.laser.sweeps=40", "-o", scans},
                    {.program = "slam6d"})
                .Wait()
                .exit_code,
            0);
  const std::vector<std::vector<std::string>> commands{
      {"--help"},
      {"register", scans, "-o", results_},
      {"register", scans, "-o", results_, "--json"},
      {"register", scans, "-o", results_, "--dry-run"},
      {"eval", scans, "--truth", scans + "/gt"},
      {"bench-search", scans},
      {"sim", "office", "--scans", "1", "--set", "sim.laser.sweeps=40", "-o", results_},
      {"config"},
      {"config", "--describe"}};
  for (const std::vector<std::string>& command : commands) ExpectTold("slam6d", command);
}

}  // namespace
}  // namespace qwsm::test
