// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a service makes of its journal.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "service/io/files/binary.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/team/journal/journaled_map.hpp"
#include "service/team/service/team_service.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/team_in_room.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

TEST(TeamJournal, NumbersGoOnBehindItsLastOneThoughTheClockWasSetBack) {
  const test::TemporaryFolder folder;
  const std::filesystem::path journal = folder.path() / "team.db";
  const std::uint64_t last = SequenceOfNow() + 3'600'000'000;
  {
    const Observation observation = test::ObservationInRoom(0);
    const TeamScan scan{.key = {.service = "base", .robot = "robot1", .sequence = last},
                        .scan = observation.scan,
                        .map_robot = {.T_a_b = test::PoseInRoom(0)},
                        .T_odom_robot = observation.T_odom_robot};
    auto file = io::JournalFile::Continue(journal, io::kScanJournal, "base");
    file.Append(std::vector{ToJournal(scan)});
  }
  test::RecordingSink sink;
  TeamServiceOptions options = test::LosslessOptions();
  options.team.robots.push_back({.name = "robot1"});
  TeamService service(options, sink, journal);
  service.Start();
  test::Give(service, "robot1", 10, 30);
  service.WaitUntilIdle();
  ASSERT_GT(sink.relevant().size(), 1U);
  EXPECT_EQ(sink.relevant().back().key.sequence, last + sink.relevant().size() - 1);
}

TEST(TeamJournal, TroubleWithItIsToldWhenItBeginsAndWhenItEnds) {
  const test::TemporaryFolder folder;
  const std::filesystem::path journal = folder.path() / "not yet" / "team.db";
  test::RecordingSink sink;
  TeamService service(test::LosslessOptions(), sink, journal);
  service.Start();
  const std::string trouble = service.Status().journal.trouble;
  EXPECT_NE(trouble, "");
  test::Give(service, "robot1", 0, 30);
  service.WaitUntilIdle();
  EXPECT_EQ(
      sink.CountEvents("service: scans cannot be stored, and wait until they can be: " + trouble),
      1);
  std::filesystem::create_directory(journal.parent_path());
  service.Stop();
  EXPECT_TRUE(sink.HasEvent("service: " + journal.string() + ": all scans are stored again"));
  EXPECT_EQ(service.Status().journal.waiting, 0U);
}

TEST(TeamJournal, IsWrittenAnewWhereSomebodyRemovesIt) {
  const test::TemporaryFolder folder;
  const std::filesystem::path journal = folder.path() / "team.db";
  test::RecordingSink sink;
  TeamService service(test::LosslessOptions(), sink, journal);
  service.Start();
  test::Give(service, "robot1", 0, 30);
  service.WaitUntilIdle();
  std::filesystem::remove(journal);
  test::Give(service, "robot1", 30, 30);
  service.WaitUntilIdle();
  service.Stop();
  EXPECT_TRUE(sink.HasEvent("service: " + journal.string() +
                            ": was removed; it is written anew, with all that was in it"));
  std::size_t stored = 0;
  io::JournalFile file = io::JournalFile::Read(journal, io::kScanJournal);
  while (file.Next()) ++stored;
  EXPECT_EQ(stored, sink.relevant().size());
}

// What was let in by an older release, and stopped it each time its map was told.
TEST(JournaledMap, LeavesOutWhatIsCalledAsNothingCanBe) {
  const auto scan_of = [](const std::string& robot, const std::string& component) {
    return TeamScan{.key = {.service = "base", .robot = robot, .sequence = 1},
                    .component = component,
                    .scan = test::ObservationInRoom(0).scan,
                    .map_robot = {.T_a_b = test::PoseInRoom(0)},
                    .T_odom_robot = {}};
  };
  JournaledMap map;
  EXPECT_THROW(map.Take(ToJournal(scan_of("robot1", "robot-2"))), io::BinaryError);
  EXPECT_THROW(map.Take(ToJournal(scan_of("robot 1", ""))), io::BinaryError);
  map.Take(ToJournal(scan_of("robot1", "")));
  TeamEpoch epoch{.rank = {.number = 7, .service = "base"}, .stamp = {}, .scans = {}};
  epoch.scans.push_back({.key = scan_of("robot1", "").key, .component = "robot-2"});
  EXPECT_THROW(map.Take(ToJournal(epoch)), io::BinaryError);
  epoch.scans.front().component = "robot2";
  epoch.rank.number = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW(map.Take(ToJournal(epoch)), io::BinaryError);
  EXPECT_EQ(map.last_epoch().number, 0U);
  const std::vector<JournaledTeamScan> scans = map.TakeScans();
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans.front().component, "");
}

}  // namespace
}  // namespace qwsm::team
