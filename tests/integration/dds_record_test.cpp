// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What robots say on the network is recorded, by a process on loopback.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "service/dds/entities/writer.hpp"
#include "service/io/bags/containers/bag_files.hpp"
#include "tests/support/demo_log.hpp"
#include "tests/support/network.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/two_lasers.hpp"

namespace qwsm::test {
namespace {

class DdsRecord : public testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  /// The path that mapping finds in a log or bag.
  std::string TrajectoryOf(const std::filesystem::path& log) const {
    const std::filesystem::path results = Path(log.filename().string() + ".results");
    const Outcome mapped =
        RunProgram({"map", log, "--output", results, "--set", "graph.enabled=false"});
    EXPECT_EQ(mapped.exit_code, 0) << mapped.errors;
    return ReadFile(results / "trajectory.tum");
  }

  PrivateNetwork network_;
  TemporaryFolder folder_;
};

class DdsRecordOfEachForm : public DdsRecord, public testing::WithParamInterface<const char*> {};

TEST_P(DdsRecordOfEachForm, GivesTheDriveBitForBit) {
  const std::string log = Path("drive.log");
  WriteDemoLog(log);
  const std::filesystem::path recording = Path(GetParam());
  Daemon recorder(network_.Join({"record", recording, "--verbose"}));
  ASSERT_TRUE(recorder.WaitUntilItSays("recording"));
  const Outcome replay = network_.Run({"replay", log, "--rate", "20"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome recorded = recorder.End(SIGINT);
  EXPECT_EQ(recorded.exit_code, 0) << recorded.errors;

  const std::string expected = TrajectoryOf(log);
  ASSERT_GT(expected.size(), 10'000U);
  EXPECT_TRUE(TrajectoryOf(recording) == expected);
}

INSTANTIATE_TEST_SUITE_P(All,
                         DdsRecordOfEachForm,
                         testing::Values("recorded.log", "recorded"),
                         [](const auto& tested) { return "Form" + std::to_string(tested.index); });

TEST_F(DdsRecord, KeepsSeveralLasersOfALogApart) {
  std::ofstream(Path("two.yaml")) << kTwoLasers;
  const Outcome simulated =
      RunProgram({"sim", Path("two.yaml"), "--duration", "10", "--output", Path("drive")});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.errors;
  const std::filesystem::path recording = Path("recorded.log");
  Daemon recorder(network_.Join({"record", recording, "--verbose"}));
  ASSERT_TRUE(recorder.WaitUntilItSays("recording"));
  const Outcome replay = network_.Run({"replay", Path("drive/robot.log"), "--rate", "10"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome recorded = recorder.End(SIGINT);
  EXPECT_EQ(recorded.exit_code, 0) << recorded.errors;

  const std::string expected = TrajectoryOf(Path("drive/robot.log"));
  ASSERT_GT(expected.size(), 10'000U);
  EXPECT_TRUE(TrajectoryOf(recording) == expected);
}

TEST_F(DdsRecord, LeavesOutOtherRobots) {
  const std::filesystem::path recording = Path("one.mcap");
  Daemon recorder(network_.Join({"record", recording, "--robot", "robot_1", "--verbose"}));
  ASSERT_TRUE(recorder.WaitUntilItSays("recording"));
  const Outcome simulated = RunProgram(network_.JoinSimulator(
      {"sim", "team", "--duration", "3", "--dds", "--output", Path("drive")}));
  EXPECT_EQ(simulated.exit_code, 0) << simulated.errors;
  const Outcome recorded = recorder.End(SIGINT);
  EXPECT_EQ(recorded.exit_code, 0) << recorded.errors;

  io::OpenBagFile bag(recording,
                      [](std::uint64_t, const std::string& what) { ADD_FAILURE() << what; });
  std::set<std::string> topics;
  while (const auto message = bag.messages().Next()) {
    topics.insert(bag.messages().topics()[message->topic].name);
  }
  const std::set<std::string> expected{"/robot_1/ground_truth",
                                       "/robot_1/initialpose",
                                       "/robot_1/odom",
                                       "/robot_1/scan",
                                       "/tf",
                                       "/tf_static"};
  EXPECT_EQ(topics, expected);
}

TEST_F(DdsRecord, OfCloudsIsRegisteredAsTheScansThatWereReplayed) {
  const std::string walk = Path("walk");
  const auto slam6d = [](std::vector<std::string> arguments) {
    return Program(std::move(arguments), Redirection{.output = {}, .program = "slam6d"}).Wait();
  };
  ASSERT_EQ(slam6d({"sim", "corridor", "--scans", "4", "--output", walk}).exit_code, 0);
  Daemon recorder(network_.Join({"record", Path("walk.mcap"), "--verbose"}));
  ASSERT_TRUE(recorder.WaitUntilItSays("recording"));
  ASSERT_EQ(slam6d(network_.Join({"replay", walk, "--period", "0.1"})).exit_code, 0);
  EXPECT_EQ(recorder.End(SIGINT).exit_code, 0);

  const auto poses_of = [&](const std::string& scans) {
    const std::string results = scans + ".results";
    const Outcome registered =
        slam6d({"register", scans, "--output", results, "--no-pictures", "--quiet"});
    EXPECT_EQ(registered.exit_code, 0) << registered.errors;
    return ReadFile(std::filesystem::path(results) / "trajectory.kitti");
  };
  const std::string expected = poses_of(walk);
  ASSERT_EQ(std::ranges::count(expected, '\n'), 4);
  EXPECT_TRUE(poses_of(Path("walk.mcap")) == expected);
}

TEST_F(DdsRecord, TellsWhatItCannotRecord) {
  const dds::Participant participant({.interface = "lo", .tag = network_.tag()});
  const dds::Writer<dds::wire::ParticipantEntitiesInfo> writer(
      participant, "/odd", dds::Profile::kAnswer);
  Daemon recorder(network_.Join({"record", Path("some.mcap")}));
  EXPECT_TRUE(recorder.WaitUntilItSays(
      "/odd (rmw_dds_common/msg/ParticipantEntitiesInfo) is not recorded: messages of this type "
      "are not known here"))
      << recorder.ErrorsSoFar();
  EXPECT_EQ(recorder.End(SIGINT).exit_code, 0);
}

}  // namespace
}  // namespace qwsm::test
