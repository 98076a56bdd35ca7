// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot with a gyro: simulated, replayed to a service and recorded, by processes on loopback.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/imu_conversion.hpp"
#include "tests/support/replay.hpp"
#include "tests/support/robot_in_room.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::test {
namespace {

constexpr const char* kWithGyro =
    "layout: {kind: rubble}\n"
    "robots:\n"
    "  - gyro: {enabled: true, bias_rad_s: 0.01}\n";

class DdsImu : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(Path("gyro.yaml")) << kWithGyro;
    const Outcome simulated =
        RunProgram({"sim", Path("gyro.yaml"), "--duration", "20", "--output", Path("drive")});
    ASSERT_EQ(simulated.exit_code, 0) << simulated.errors;
    const Outcome converted = RunProgram({"convert", Path("drive/robot.log"), "-o", bag_});
    ASSERT_EQ(converted.exit_code, 0) << converted.errors;
  }

  std::string Path(const std::string& name) const { return folder_.path() / name; }
  /// The path that mapping finds in a log or bag.
  std::string TrajectoryOf(const std::string& log) const {
    const std::string results = log + ".results";
    const Outcome mapped = RunProgram({"map", log, "--output", results});
    EXPECT_EQ(mapped.exit_code, 0) << mapped.errors;
    return ReadFile(results + "/trajectory_live.tum");
  }

  TemporaryFolder folder_;
  std::string bag_ = Path("drive.mcap");
  PrivateNetwork network_;
};

TEST_F(DdsImu, OfABagGivesItsPathBitForBit) {
  ASSERT_NO_FATAL_FAILURE(MapOverNetworkAndFromFile(network_, bag_, folder_.path()));
  ExpectSamePath(Path("served"), Path("mapped"));
  EXPECT_TRUE(TrajectoryOf(Path("drive/robot.log")) == ReadFile(Path("mapped/trajectory_live.tum")))
      << "the log it was made of";
}

TEST_F(DdsImu, IsRecordedInLogsAndInBags) {
  const std::string expected = TrajectoryOf(bag_);
  for (const char* name : {"recorded.log", "recorded"}) {
    SCOPED_TRACE(name);
    Daemon recorder(network_.Join({"record", Path(name), "--verbose"}));
    ASSERT_TRUE(recorder.WaitUntilItSays("recording"));
    const Outcome replay = network_.Run({"replay", bag_, "--rate", "20"});
    ASSERT_EQ(replay.exit_code, 0) << replay.errors;
    const Outcome recorded = recorder.End(SIGINT);
    EXPECT_EQ(recorded.exit_code, 0) << recorded.errors;
    EXPECT_TRUE(TrajectoryOf(Path(name)) == expected);
  }
}

TEST_F(DdsImu, ThatMakesNoSenseIsRefusedAndToldOnce) {
  RobotInRoom robot(network_);
  const dds::Writer<dds::wire::Imu> imu(
      robot.participant(), "/robot1/imu", dds::Profile::kFastSensorOut);
  Daemon service(network_.JoinService({"serve"}));
  std::size_t answers = 0;
  for (int i = 0; i < 1000 && answers < 20; ++i) {
    const Observation observation = robot.NextObservation();
    imu.Write(dds::ToWire({.stamp = observation.scan.stamp, .turn_rate_rad_s = {0.0, 0.0, 1e9}},
                          "robot1/base_link"));
    robot.Publish(observation);
    answers += robot.Hear(std::chrono::milliseconds(5)).size();
  }
  EXPECT_GE(answers, 20U);
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0);
  EXPECT_NE(served.errors.find("/robot1/imu: a sample was refused: it turns at no rate"),
            std::string::npos)
      << served.errors;
}

}  // namespace
}  // namespace qwsm::test
