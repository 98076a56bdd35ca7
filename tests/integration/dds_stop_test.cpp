// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// SIGTERM after a quarter of an hour in an office: all is saved, and soon.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "tests/support/network.hpp"
#include "tests/support/replay.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

class DdsStop : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome drive = RunProgram({"sim",
                                      "office",
                                      "--duration",
                                      "900",
                                      "--set",
                                      "layout.office.rooms_per_side=9",
                                      "--output",
                                      Path("drive")});
    ASSERT_EQ(drive.exit_code, 0) << drive.errors;
  }

  fs::path Path(const char* name) const { return folder_.path() / name; }

  std::size_t StoredScans() const {
    io::JournalFile journal = io::JournalFile::Read(Path("team.db"), io::kScanJournal);
    std::size_t count = 0;
    while (journal.Next()) ++count;
    return count;
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

// The second that a service may take is one of wall-clock time, which a busy machine stretches. So
// its processor time is judged, by a yardstick of the same run: what the drive has cost the service
// until then, some two seconds.
TEST_F(DdsStop, SavesAllInAThirdOfTheTimeThatTheDriveTook) {
  const fs::path log = Path("drive") / "robot.log";
  Daemon service(
      network_.JoinService({"serve", "--output", Path("served"), "--journal", Path("team.db")}));
  const Outcome replay = network_.Run({"replay", log, "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const std::chrono::nanoseconds drive = service.CpuSoFar();
  const auto begun = std::chrono::steady_clock::now();
  const Outcome served = service.End(SIGTERM);
  const Seconds stopping = std::chrono::steady_clock::now() - begun;
  ASSERT_EQ(served.exit_code, 0) << served.errors;

  ASSERT_EQ(RunProgram({"map", log, "--output", Path("corrected")}).exit_code, 0);
  ExpectSamePath(Path("served"), Path("corrected"));
  ExpectSameMap(Path("served"), Path("corrected"));
  const Outcome mapped =
      RunProgram({"map", log, "--output", Path("mapped"), "--set", "graph.enabled=false"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  for (const auto& [served_file, mapped_file] :
       {std::pair("trajectory_live.tum", "trajectory.tum"), std::pair("map_live.png", "map.png")}) {
    const std::string expected = ReadFile(Path("mapped") / mapped_file);
    ASSERT_FALSE(expected.empty()) << mapped_file;
    EXPECT_TRUE(ReadFile(Path("served") / served_file) == expected) << served_file;
  }
  EXPECT_GT(fs::file_size(Path("served") / "trajectory.png"), 10'000U);
  const std::string relevant = std::to_string(StoredScans()) + " relevant scans";
  EXPECT_NE(served.output.find(relevant), std::string::npos) << relevant << '\n' << served.output;

  std::cout << "stopped in " << stopping.count() << " s, of which "
            << Seconds(served.cpu - drive).count() << " s of the processor; the drive took "
            << Seconds(drive).count() << " s of it\n";
  EXPECT_LT(served.cpu - drive, drive / 3);
}

}  // namespace
}  // namespace qwsm::test
