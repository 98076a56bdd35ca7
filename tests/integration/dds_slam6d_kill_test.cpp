// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// kill -9 of services for clouds, as processes on loopback: the model is as if nothing had been.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/io/clouds/cloud_codec.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "tests/support/drive3.hpp"
#include "tests/support/network.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr int kScansOfDrive = 16;

Timestamp StampOf(int scan) { return std::chrono::seconds(scan + 1); }

/// A robot that drives in a circle and says each scan until it is told to be in the model.
class CloudRobot {
 public:
  explicit CloudRobot(const PrivateNetwork& network)
      : participant_({.interface = "lo", .tag = network.tag(), .node = "test"}),
        reports_(participant_, {"robot1"}),
        publisher_(participant_, dds::RobotNames("robot1"), dds::OdometryUse::kPublished) {}

  void Publish(int scan) {
    const auto i = static_cast<std::size_t>(scan);
    publisher_.Publish(
        {.scan = {.stamp = StampOf(scan), .cloud = drive_.scans[i], .T_robot_sensor = {}},
         .T_odom_robot = drive_.T_odom_scan[i]});
  }
  bool PublishUntilReported(int scan) {
    for (int tries = 0; tries < 300 && !reported_.contains(StampOf(scan)); ++tries) {
      Publish(scan);
      Hear(50ms);
    }
    return reported_.contains(StampOf(scan));
  }
  void Hear(std::chrono::milliseconds period) {
    for (const dds::RegistrationReport& report : reports_.Take(period)) {
      reported_.insert(report.stamp);
    }
  }
  /// Stamps of the scans that are in the model as services told.
  const std::set<Timestamp>& reported() const { return reported_; }

 private:
  slam6d::Drive3 drive_ = slam6d::DriveInCircle(kScansOfDrive, 4000, 5);
  dds::Participant participant_;
  dds::RegistrationReportReader reports_;
  dds::CloudRobotPublisher publisher_;
  std::set<Timestamp> reported_;
};

class DdsSlam6dKill : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_.path() / name; }
  Daemon Serve(const std::string& name) const {
    return Daemon(network_.JoinService({"serve",
                                        "--verbose",
                                        "--journal",
                                        Path(name + ".db"),
                                        "--output",
                                        Path(name),
                                        "--force"}),
                  "slam6d");
  }
  std::set<Timestamp> Stored(const std::string& name) const {
    std::set<Timestamp> stamps;
    if (!io::IsSqliteDatabase(Path(name + ".db"))) return stamps;  // Killed before it was begun.
    io::JournalFile journal = io::JournalFile::Read(Path(name + ".db"), slam6d::io::kCloudJournal);
    while (const auto entry = journal.Next()) stamps.insert(entry->stamp);
    EXPECT_EQ(journal.damaged(), 0U);
    return stamps;
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(DdsSlam6dKill, ServiceKilledAtEveryScanHasTheModelOfOneThatLived) {
  {
    Daemon service = Serve("lived");
    CloudRobot robot(network_);
    for (int scan = 0; scan < kScansOfDrive; ++scan) ASSERT_TRUE(robot.PublishUntilReported(scan));
    EXPECT_EQ(service.End().exit_code, 0);
  }
  CloudRobot robot(network_);
  std::mt19937 random(5);
  for (int scan = 0; scan < kScansOfDrive; ++scan) {
    SCOPED_TRACE(scan);
    Daemon service = Serve("killed");
    const bool was_stored = Stored("killed").contains(StampOf(scan));
    ASSERT_TRUE(was_stored || robot.PublishUntilReported(scan));
    if (scan + 1 < kScansOfDrive) robot.Publish(scan + 1);  // May be in the journal or not.
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 30'000));
    service.End(SIGKILL);
    robot.Hear(10ms);
    ASSERT_TRUE(std::ranges::includes(Stored("killed"), robot.reported()));
  }
  Daemon service = Serve("killed");
  ASSERT_TRUE(service.WaitUntilItSays("robot1: has its 16 scans back from the journal"))
      << service.ErrorsSoFar();
  EXPECT_EQ(service.End().exit_code, 0);
  const std::string expected = ReadFile(Path("lived/robot1/trajectory.tum"));
  EXPECT_EQ(std::ranges::count(expected, '\n'), kScansOfDrive);
  EXPECT_EQ(ReadFile(Path("killed/robot1/trajectory.tum")), expected);
  EXPECT_TRUE(ReadFile(Path("killed/robot1/model.ply")) ==
              ReadFile(Path("lived/robot1/model.ply")));
}

}  // namespace
}  // namespace qwsm::test
