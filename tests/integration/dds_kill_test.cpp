// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// kill -9 of services, as processes on loopback: what they told is still there.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "service/io/journal_file.hpp"
#include "service/io/scan_codec.hpp"
#include "service/io/sqlite_database.hpp"
#include "tests/support/robot_in_room.hpp"

namespace qwsm::test {
namespace {

using namespace std::chrono_literals;

constexpr int kKills = 100;

class DdsKill : public ::testing::Test {
 protected:
  std::filesystem::path Journal() const { return folder_.path() / "team.db"; }
  /// Many scans are relevant: there is much to store.
  std::vector<std::string> Serve(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"serve", "--verbose"});
    more.insert(more.end(), {"--set", "mapper.relevant_translation_m=0.2"});
    return network_.Join(more);
  }
  /// Stamps of the scans in the journal.
  std::set<Timestamp> Stored() const {
    std::set<Timestamp> stamps;
    if (!io::IsSqliteDatabase(Journal())) return stamps;  // Killed before it was begun.
    io::JournalFile journal = io::JournalFile::Read(Journal(), io::kScanJournal);
    while (const auto entry = journal.Next()) stamps.insert(entry->stamp);
    EXPECT_EQ(journal.damaged(), 0U);
    return stamps;
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

/// What services have told.
struct Told {
  std::set<Timestamp> reported;  ///< Relevant scans by their match reports.
  std::set<Timestamp> shared;    ///< Relevant scans offered to other services.
  std::size_t answers = 0;

  void Take(RobotInRoom& robot, const std::vector<dds::MatchReport>& reports) {
    for (const dds::MatchReport& report : reports) {
      ++answers;
      EXPECT_NE(report.status, StepStatus::kDeadReckoned);
      if (report.relevant) reported.insert(report.stamp);
    }
    for (const team::TeamScan& scan : robot.TakeSharedScans()) shared.insert(scan.scan.stamp);
  }
};

TEST_F(DdsKill, ServiceKilledAHundredTimesLosesNoScanItToldAndMatchesTheNextOne) {
  RobotInRoom robot(network_);
  Told told;
  std::mt19937 random(5);
  for (int kill = 0; kill < kKills; ++kill) {
    SCOPED_TRACE(kill);
    Daemon service(Serve({"--journal", Journal()}));
    const std::size_t answers = random() % 24;
    told.Take(robot, robot.DriveUntilAnswered(answers));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 10'000));
    service.End(SIGKILL);
    told.Take(robot, robot.Hear(5ms));
    const std::set<Timestamp> stored = Stored();
    ASSERT_TRUE(std::ranges::includes(stored, told.reported));
    ASSERT_TRUE(std::ranges::includes(stored, told.shared));
  }
  EXPECT_GT(told.answers, 500U);
  EXPECT_GT(told.reported.size(), 50U);

  Daemon service(Serve({"--journal", Journal()}));
  const std::vector<dds::MatchReport> next = robot.DriveUntilAnswered(1);
  ASSERT_FALSE(next.empty());
  EXPECT_TRUE(next.front().status == StepStatus::kMatched ||
              next.front().status == StepStatus::kExtended)
      << next.front().reason;
  EXPECT_TRUE(robot.DriveUntil("qwsm: service", "map_scans", [&](const std::string& scans) {
    return std::stoul(scans) >= told.reported.size();
  }));
}

}  // namespace
}  // namespace qwsm::test
