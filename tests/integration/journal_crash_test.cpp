// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a service reported as stored is there again, whatever became of its process or its disk.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/team/service/team_service.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

constexpr int kKillsOfJournal = 100;
constexpr int kScansOfALap = 126;

TeamServiceOptions LosslessOptions() {
  TeamServiceOptions options;
  options.team.session.queue_scans = 100'000;
  options.team.session.odometry_wait_s = 10.0;
  options.team.map_period_s = 0.0;
  options.mapper.relevant_translation_m = 0.2;  // Much to store.
  return options;
}

/// The robot drives round and round, from where it is in the lap.
void Give(TeamService& service, int first, int count) {
  for (int scan = first; scan < first + count; ++scan) {
    const Observation observation = test::ObservationInRoom(scan);
    service.robots().TakeOdometry("robot1", observation.scan.stamp, *observation.T_odom_robot);
    service.robots().TakeScan("robot1", observation.scan);
  }
}

constexpr std::uint64_t kNotMatched = 0;  // No scan has that number.

/// Tells the sequence numbers of relevant scans as they are shared, and poses without a match.
class ScanTeller final : public test::RecordingSink {
 public:
  explicit ScanTeller(test::ChildProcess::Tell tell) : tell_(std::move(tell)) {}
  void TakeRelevantScan(const TeamScan& scan) override { tell_(scan.key.sequence); }
  void TakeAnswer(const RobotAnswer& answer) override {
    if (answer.step.status == StepStatus::kDeadReckoned) tell_(kNotMatched);
  }

 private:
  test::ChildProcess::Tell tell_;
};

/// A service that is killed at some moment after it has reported `patience` relevant scans more.
/// @return the sequence numbers it reported.
std::set<std::uint64_t> RunUntilKilled(const std::filesystem::path& journal,
                                       int first_scan,
                                       std::mt19937& random) {
  test::ChildProcess child([&](const test::ChildProcess::Tell& tell) {
    ScanTeller sink(tell);
    TeamService service(LosslessOptions(), sink, journal);
    service.Start();
    Give(service, first_scan, kScansOfALap);
    service.WaitUntilIdle();
    pause();
  });
  std::set<std::uint64_t> reported;
  const auto known = io::IsSqliteDatabase(journal)
                         ? io::JournalFile::Read(journal, io::kScanJournal).size()
                         : std::size_t{0};
  const std::size_t patience = known + random() % 6;
  while (reported.size() < patience) {
    const std::optional<std::uint64_t> sequence = child.Hear();
    if (!sequence) break;
    reported.insert(*sequence);
  }
  for (auto spin = random() % 500'000; spin > 0; --spin) asm volatile("");
  child.Kill();
  while (const std::optional<std::uint64_t> sequence = child.Hear()) reported.insert(*sequence);
  return reported;
}

TEST(JournalCrash, ServiceKilledAHundredTimesLosesNoScanItSharedAndMatchesTheNextOne) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "team.journal";
  std::mt19937 random(11);
  std::set<std::uint64_t> reported;
  int next_scan = 0;
  for (int kill = 0; kill < kKillsOfJournal; ++kill) {
    SCOPED_TRACE(kill);
    reported.merge(RunUntilKilled(file, next_scan, random));
    ASSERT_FALSE(reported.contains(kNotMatched));
    if (!io::IsSqliteDatabase(file)) {  // Killed before it was begun.
      ASSERT_TRUE(reported.empty());
      continue;
    }
    std::set<std::uint64_t> restored;
    io::JournalFile journal = io::JournalFile::Continue(file, io::kScanJournal, "unused");
    while (const auto entry = journal.Next()) {
      EXPECT_TRUE(restored.insert(entry->sequence).second);
      next_scan = static_cast<int>(entry->stamp / std::chrono::milliseconds(100)) + 1;
    }
    EXPECT_EQ(journal.damaged(), 0U);
    EXPECT_TRUE(std::ranges::includes(restored, reported));
  }
  EXPECT_GT(reported.size(), 50U);

  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink, file);
  service.Start();
  Give(service, next_scan, 1);
  service.WaitUntilIdle();
  EXPECT_GE(service.Status().map.scans, reported.size());
  ASSERT_EQ(sink.steps("robot1").size(), 1U);
  EXPECT_NE(sink.steps("robot1").front().status, StepStatus::kDeadReckoned);
  const Pose2 error =
      test::PoseInRoom(next_scan).Inverse() * sink.steps("robot1").front().map_robot.T_a_b;
  EXPECT_LT(error.translation_m().norm(), 0.1);
}

TEST(JournalCrash, MapIsTheSameBitForBitAfterARestart) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "team.journal";
  std::string before;
  {
    test::RecordingSink sink;
    TeamService service(LosslessOptions(), sink, file);
    service.Start();
    Give(service, 0, kScansOfALap);
    service.WaitUntilIdle();
    before = io::EncodeMap(service.MapOf("robot1")->Read()->map);
    const std::vector<MappingStep> reports = sink.reports("robot1");  // In order, though they wait.
    EXPECT_EQ(reports.size(), static_cast<std::size_t>(kScansOfALap));
    EXPECT_TRUE(std::ranges::is_sorted(reports, {}, &MappingStep::stamp));
  }
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink, file);
  EXPECT_EQ(io::EncodeMap(service.MapOf("robot1")->Read()->map), before);
  service.Start();  // What it has is offered to the other services again.
  EXPECT_EQ(sink.relevant().size(), service.Status().map.scans);
}

void LimitFileSize(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
}

TEST(JournalCrash, FullDiskIsToldAndMatchingGoesOnAndNothingIsLostOnceThereIsRoom) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "team.journal";
  test::ChildProcess child([&](const test::ChildProcess::Tell& tell) {
    std::signal(SIGXFSZ, SIG_IGN);
    LimitFileSize(100'000);
    test::RecordingSink sink;
    TeamService service(LosslessOptions(), sink, file);
    service.Start();
    Give(service, 0, kScansOfALap);
    service.WaitUntilIdle();
    const auto is_writing = [&] {
      const auto journal = service.Status().journal;
      return journal.waiting > 0 && journal.trouble.empty();
    };
    while (is_writing()) std::this_thread::yield();  // In a thread of its own.
    const TeamStatus full = service.Status();
    tell(full.robots.at(0).counts.answered);
    tell(full.journal.trouble.empty() ? 0 : 1);
    tell(full.journal.stored + full.journal.waiting);
    tell(full.map.scans);
    LimitFileSize(RLIM_INFINITY);
    while (service.Status().journal.waiting > 0) std::this_thread::yield();
    tell(service.Status().journal.trouble.empty() ? 0 : 1);
  });
  EXPECT_EQ(child.Hear(), kScansOfALap);
  EXPECT_EQ(child.Hear(), 1U);
  const std::optional<std::uint64_t> accounted = child.Hear();
  const std::optional<std::uint64_t> scans = child.Hear();
  EXPECT_EQ(accounted, scans);
  EXPECT_EQ(child.Hear(), 0U);
  EXPECT_EQ(child.Wait(), 0);
  EXPECT_EQ(io::JournalFile::Read(file, io::kScanJournal).size(), scans);
}

TEST(JournalCrash, JournalThatCannotBeBegunIsToldAndMatchingGoesOn) {
  const test::TemporaryFolder folder;
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink, folder.path() / "missing" / "team.journal");
  service.Start();
  Give(service, 0, 20);
  service.WaitUntilIdle();
  EXPECT_EQ(service.Status().robots.at(0).counts.answered, 20U);
  EXPECT_FALSE(service.Status().journal.trouble.empty());
  EXPECT_EQ(sink.relevant().size(), service.Status().map.scans);  // Others may keep it.
}

}  // namespace
}  // namespace qwsm::team
