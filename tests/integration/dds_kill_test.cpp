// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// kill -9 of services, as processes on loopback: what they told is still there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/journal/sqlite_database.hpp"
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
  std::size_t dead_reckonings = 0;
  std::string dead_reckoned;  ///< What is told of answers without a match, a line each.

  void Take(RobotInRoom& robot, const std::vector<dds::MatchReport>& reports) {
    for (const dds::MatchReport& report : reports) {
      ++answers;
      if (report.status == StepStatus::kDeadReckoned) Note(report);
      if (report.relevant) reported.insert(report.stamp);
    }
    for (const team::TeamScan& scan : robot.TakeSharedScans()) shared.insert(scan.scan.stamp);
  }
  void Note(const dds::MatchReport& report) {
    ++dead_reckonings;
    const std::chrono::duration<double> latency = report.latency;
    dead_reckoned += fmt::format("answer {}, scan {} of its service, stamp {} ns, after {} s: {}\n",
                                 answers,
                                 report.scans,
                                 report.stamp.count(),
                                 latency.count(),
                                 report.reason);
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
  // One in a hundred, whose odometry came too late on a busy machine. Were the next scan not
  // matched after each kill, it would be one in ten.
  EXPECT_LE(told.dead_reckonings, told.answers / 100) << told.dead_reckoned;
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

/// Drives until a service of that name shares a relevant scan. @returns false after 40 seconds.
bool DriveUntilSharedBy(const std::string& service, RobotInRoom& robot) {
  for (int i = 0; i < 4000; ++i) {
    robot.Drive(10ms);
    for (const team::TeamScan& scan : robot.TakeSharedScans()) {
      if (scan.key.service.starts_with(service + "-")) return true;
    }
  }
  return false;
}

/// Waits until two services have told for two seconds of equally many scans in their maps, without
/// driving. @returns false after 30 seconds.
bool HaveAgreed(RobotInRoom& robot) {
  std::map<std::string, std::string> scans_of;
  auto since = std::chrono::steady_clock::now();
  for (int i = 0; i < 3000; ++i) {
    robot.Hear(10ms);
    const std::map<std::string, std::string> health = robot.HealthOf("qwsm: service");
    if (!health.contains("map_scans")) continue;
    std::string& scans = scans_of[health.at("message")];
    const bool is_news = std::exchange(scans, health.at("map_scans")) != health.at("map_scans");
    const bool agree = scans_of.size() >= 2 && std::ranges::all_of(scans_of, [&](const auto& one) {
                         return one.second == scans;
                       });
    const auto now = std::chrono::steady_clock::now();
    if (is_news || !agree) since = now;
    if (now > since + 2s) return true;
  }
  return false;
}

TEST_F(DdsKill, SurvivorOfTwoServicesTakesOverTheRobotAndKeepsTheMapForTheOtherOne) {
  RobotInRoom robot(network_);
  const std::vector<std::string> serve_first =
      Serve({"robot1", "--output", folder_.path() / "1", "--force", "--set", "team.service=first"});
  Daemon second(Serve({"--output", folder_.path() / "2", "--set", "team.service=second"}));
  {
    Daemon first(serve_first);
    ASSERT_TRUE(DriveUntilSharedBy("first", robot));
    robot.DriveUntilAnswered(300);
    first.End(SIGKILL);
  }
  // Nothing tells of the death but its silence, for ten seconds.
  ASSERT_TRUE(DriveUntilSharedBy("second", robot)) << second.ErrorsSoFar();
  robot.DriveUntilAnswered(100);

  Daemon first(serve_first);
  ASSERT_TRUE(DriveUntilSharedBy("first", robot)) << first.ErrorsSoFar();
  EXPECT_TRUE(HaveAgreed(robot)) << first.ErrorsSoFar() << second.ErrorsSoFar();
  const Outcome of_first = first.End();
  const Outcome of_second = second.End();
  EXPECT_NE(of_second.errors.find("robot1: is answered by another service"), std::string::npos);
  EXPECT_EQ(of_first.errors.find("fits nowhere"), std::string::npos);
  const std::string map = ReadFile(folder_.path() / "1/map.pgm");
  EXPECT_GT(map.size(), 1000U);
  EXPECT_TRUE(map == ReadFile(folder_.path() / "2/map.pgm"));
}

}  // namespace
}  // namespace qwsm::test
