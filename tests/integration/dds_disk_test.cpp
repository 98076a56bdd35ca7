// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A service whose journal cannot be written, as a process on loopback: it says so on its status
// topic, goes on matching, and stores what has waited as soon as it can.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

/// No file of the process may become longer: as a full disk, but without the rights to make one.
void LimitFileSize(pid_t process, rlim_t bytes) {
  rlimit limit{};
  ASSERT_EQ(prlimit(process, RLIMIT_FSIZE, nullptr, &limit), 0);
  limit.rlim_cur = std::min(bytes, limit.rlim_max);
  ASSERT_EQ(prlimit(process, RLIMIT_FSIZE, &limit, nullptr), 0);
}

class DdsDisk : public ::testing::Test {
 protected:
  std::vector<std::string> Serve(const std::filesystem::path& journal) const {
    return network_.Join({"serve",
                          "--verbose",
                          "--journal",
                          journal,
                          "--set",
                          "mapper.relevant_translation_m=0.2",
                          "--set",
                          "team.status_period_s=0.2"});
  }
  /// Drives until all is stored, and then checks that nothing is missing that was reported.
  void ExpectAllStored(RobotInRoom& robot, const std::filesystem::path& journal) {
    EXPECT_TRUE(robot.DriveUntil("qwsm: journal", "message", [&](const std::string& message) {
      return message == journal.string();  // No trouble.
    }));
    EXPECT_TRUE(robot.DriveUntil(
        "qwsm: journal", "waiting", [](const std::string& scans) { return scans == "0"; }));
    std::set<Timestamp> stored;
    io::JournalFile file = io::JournalFile::Read(journal, io::kScanJournal);
    while (const auto entry = file.Next()) stored.insert(entry->stamp);
    EXPECT_GT(told_.size(), 10U);
    EXPECT_TRUE(std::ranges::includes(stored, told_));
  }
  void DriveOn(RobotInRoom& robot, std::size_t scans) {
    const std::vector<dds::MatchReport> reports = robot.DriveUntilAnswered(scans);
    EXPECT_GE(reports.size(), scans);
    for (const dds::MatchReport& report : reports) {
      EXPECT_NE(report.status, StepStatus::kDeadReckoned);
      if (report.relevant) told_.insert(report.stamp);
    }
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
  std::set<Timestamp> told_;  // Reported as relevant.
};

TEST_F(DdsDisk, FullDiskIsToldAndMatchingGoesOnAndNothingIsLostOnceThereIsRoom) {
  const std::filesystem::path journal = folder_.path() / "team.db";
  RobotInRoom robot(network_);
  Daemon service(Serve(journal));
  DriveOn(robot, 30);
  ASSERT_NO_FATAL_FAILURE(LimitFileSize(service.process(), 100'000));
  EXPECT_TRUE(robot.DriveUntil("qwsm: journal", "message", [&](const std::string& message) {
    return message != journal.string();
  })) << service.ErrorsSoFar();
  DriveOn(robot, 100);
  ASSERT_NO_FATAL_FAILURE(LimitFileSize(service.process(), RLIM_INFINITY));
  ExpectAllStored(robot, journal);
  EXPECT_EQ(service.End().exit_code, 0);
}

TEST_F(DdsDisk, JournalThatCannotBeBegunIsToldAndBegunOnceItCanBe) {
  const std::filesystem::path journal = folder_.path() / "not yet" / "team.db";
  RobotInRoom robot(network_);
  Daemon service(Serve(journal));
  EXPECT_TRUE(robot.DriveUntil("qwsm: journal", "message", [&](const std::string& message) {
    return message.find("cannot") != std::string::npos ||
           message.find("unable") != std::string::npos;
  })) << service.ErrorsSoFar();
  DriveOn(robot, 100);
  std::filesystem::create_directory(journal.parent_path());
  ExpectAllStored(robot, journal);
  EXPECT_EQ(service.End().exit_code, 0);
}

TEST_F(DdsDisk, ServiceThatIsStoppedWhileItsJournalCannotBeWrittenSaysSoInItsExitCode) {
  RobotInRoom robot(network_);
  Daemon service(Serve(folder_.path() / "nowhere" / "team.db"));
  EXPECT_TRUE(robot.DriveUntil("qwsm: journal", "waiting", [](const std::string& scans) {
    return !scans.empty() && scans != "0";
  })) << service.ErrorsSoFar();
  EXPECT_EQ(service.End().exit_code, 3);
}

}  // namespace
}  // namespace qwsm::test
