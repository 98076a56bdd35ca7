// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A log through the network: `qwsm replay`, `qwsm serve` and `qwsm echo` as processes on loopback.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/service/mark_exchange.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/demo_log.hpp"
#include "tests/support/network.hpp"
#include "tests/support/replay.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class DdsReplay : public ::testing::Test {
 protected:
  void SetUp() override { WriteDemoLog(Log()); }

  std::string Log() const { return Path("two-rooms.log"); }
  std::string Path(const char* name) const { return folder_.path() / name; }

  /// The log as if the last 15 of its 114 seconds had been driven two hours later.
  std::string LogWithPause() const {
    const std::string stamp = " 10000001";  // ..00 to ..14, in seconds; the log starts at 1e9.
    std::string text = ReadFile(Log());
    for (std::size_t at = 0; (at = text.find(stamp, at)) != std::string::npos;) {
      text.replace(at, stamp.size(), " 10000073");
    }
    std::ofstream(Path("pause.log"), std::ios::binary) << text;
    return Path("pause.log");
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsReplay, GivesThePathOfTheLogBitForBit) {
  ASSERT_NO_FATAL_FAILURE(MapOverNetworkAndFromFile(network_, Log(), folder_.path()));
  ExpectSamePath(Path("served"), Path("mapped"));
  ExpectSameMap(Path("served"), Path("mapped"));
  EXPECT_FALSE(ReadFile(Path("served/trajectory.tum")) ==
               ReadFile(Path("served/trajectory_live.tum")))
      << "nothing was corrected";
  for (const char* picture : {"map.png", "map_live.png", "trajectory.png"}) {
    EXPECT_TRUE(fs::exists(Path("served") + "/" + picture)) << picture;
  }
}

TEST_F(DdsReplay, LosesNoScanAfterAPauseOfHours) {
  ASSERT_NO_FATAL_FAILURE(MapOverNetworkAndFromFile(network_, LogWithPause(), folder_.path()));
  const std::string expected = ReadFile(Path("mapped/trajectory_live.tum"));
  ASSERT_NE(expected.find("\n1000007300"), std::string::npos);
  ExpectSamePath(Path("served"), Path("mapped"));
}

TEST_F(DdsReplay, LeavesThePathAsAnsweredWhereNothingIsCorrected) {
  const std::string as_it_is = "graph.enabled=false";
  Daemon service(network_.JoinService({"serve", "--output", Path("served"), "--set", as_it_is}));
  const Outcome replay = network_.Run({"replay", Log(), "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  ASSERT_EQ(service.End().exit_code, 0);
  const Outcome mapped = RunProgram({"map", Log(), "--output", Path("mapped"), "--set", as_it_is});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  EXPECT_TRUE(ReadFile(Path("served/trajectory.tum")) == ReadFile(Path("mapped/trajectory.tum")));
  EXPECT_FALSE(fs::exists(Path("served/trajectory_live.tum")));
  EXPECT_FALSE(fs::exists(Path("served/loops.csv")));
}

/// Where a list of marks has the only one.
Eigen::Vector2d PlaceOfMark(const std::string& list) {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const std::size_t name = list.find("\"Anna\",");
  if (name != std::string::npos) {
    sscanf(list.c_str() + name, "\"Anna\",%lf,%lf", &p_map_m.x(), &p_map_m.y());
  }
  return p_map_m;
}

// The park is driven round once: at its end the answers have drifted by decimetres.
TEST_F(DdsReplay, LeavesMarksWhereTheCorrectedMapHasTheirScans) {
  ASSERT_EQ(RunProgram({"sim", "park", "--output", Path("drive")}).exit_code, 0);
  const std::string log = Path("drive/robot.log");
  ASSERT_EQ(RunProgram({"map", log, "--output", Path("mapped")}).exit_code, 0);
  const Trajectory answered = io::ReadTumFile(Path("mapped/trajectory_live.tum"));
  const Trajectory corrected = io::ReadTumFile(Path("mapped/trajectory.tum"));
  ASSERT_EQ(answered.size(), corrected.size());
  std::vector<double> moved_m;
  for (std::size_t i = 0; i < answered.size(); ++i) {
    moved_m.push_back(
        (answered[i].T_map_robot.translation_m() - corrected[i].T_map_robot.translation_m())
            .norm());
  }
  const auto farthest = std::ranges::max_element(moved_m);
  const auto there = static_cast<std::size_t>(farthest - moved_m.begin());
  ASSERT_GT(*farthest, 0.1);

  Daemon service(network_.JoinService({"serve", "--output", Path("served")}));
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  dds::Refusals refusals([](const std::string&) {});
  dds::MarkExchange operators(
      participant, refusals, team::MarkJournal({}, [](const std::string&) {}));
  operators.Start();
  ASSERT_EQ(network_.Run({"replay", log, "--rate", "max"}).exit_code, 0);
  std::this_thread::sleep_for(500ms);  // Nothing tells that all scans were heard of, nor the mark.
  operators.Tell({.id = "anna",
                  .kind = "victim",
                  .text = "Anna",
                  .p_map_m = answered[there].T_map_robot.translation_m()});
  std::this_thread::sleep_for(500ms);
  ASSERT_EQ(service.End().exit_code, 0);
  const Eigen::Vector2d mark_m = PlaceOfMark(ReadFile(Path("served/marks.csv")));
  EXPECT_LT((mark_m - corrected[there].T_map_robot.translation_m()).norm(), 0.02);
}

TEST_F(DdsReplay, IsHeardPoseByPose) {
  Daemon service(network_.JoinService({"serve"}));
  Daemon echo(network_.Join({"echo", "robot1", "--to", "tum", "--verbose"}));
  ASSERT_TRUE(echo.WaitUntilItSays("listening"));
  const Outcome replay = network_.Run({"replay", Log(), "--robot", "robot1", "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_NE(replay.output.find("dropped by the service 0"), std::string::npos) << replay.output;

  const Outcome mapped =
      RunProgram({"map", Log(), "--output", Path("mapped"), "--set", "graph.enabled=false"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
  // Who has only just found the service may miss its first words.
  const std::string expected = ReadFile(Path("mapped/trajectory.tum"));
  const std::string heard = echo.End().output;
  EXPECT_TRUE(expected.ends_with(heard));
  EXPECT_GT(heard.size(), expected.size() * 9 / 10);
}

TEST_F(DdsReplay, SaysThatNobodyListens) {
  const Outcome replay = network_.Run({"replay", Log(), "--robot", "robot7", "--wait", "0.2"});
  EXPECT_EQ(replay.exit_code, 1);
  EXPECT_NE(replay.errors.find("nobody listens to /robot7/scan"), std::string::npos)
      << replay.errors;
}

// Of so few scans no answer is waited for but the last.
TEST_F(DdsReplay, SaysThatTheServiceHasHadItsScansBefore) {
  WriteRoomLog(Path("short.log"), 3);
  Daemon service(network_.JoinService({"serve"}));
  ASSERT_EQ(network_.Run({"replay", Path("short.log"), "--rate", "max"}).exit_code, 0);
  const Outcome again = network_.Run({"replay", Path("short.log"), "--rate", "max"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.errors.find("no scan was answered: a service takes none that is older"),
            std::string::npos)
      << again.errors;
}

TEST_F(DdsReplay, RefusesWhatItCannotDo) {
  EXPECT_EQ(network_.Run({"replay", Log(), "--rate", "fast"}).exit_code, 2);
  EXPECT_EQ(network_.Run({"replay", Log(), "--robot", "a b"}).exit_code, 2);
  EXPECT_EQ(RunProgram({"serve", "--set", "network.interface=nowhere0"}).exit_code, 2);
}

}  // namespace
}  // namespace qwsm::test
