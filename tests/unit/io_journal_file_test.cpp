// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "service/io/logs/log_reader.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

using test::ObservationInRoom;

JournalEntry EntryOf(int scan) {
  const Observation observation = ObservationInRoom(scan);
  JournaledScan journaled{
      .relevant = {.scan = observation.scan, .map_robot = {.T_a_b = test::PoseInRoom(scan)}},
      .T_odom_robot = observation.T_odom_robot};
  return {.service = "base",
          .robot = "robot1",
          .sequence = static_cast<std::uint64_t>(scan),
          .stamp = observation.scan.stamp,
          .contents = EncodeScan(journaled)};
}

class JournalFileTest : public testing::Test {
 protected:
  JournalFile Continue() const { return JournalFile::Continue(file_, kScanJournal, "base-1"); }
  void Write(int scans) const {
    std::vector<JournalEntry> entries;
    for (int scan = 1; scan <= scans; ++scan) entries.push_back(EntryOf(scan));
    Continue().Append(entries);
  }
  std::string Complaint() const {
    try {
      JournalFile journal = Continue();
      while (journal.Next()) {
      }
    } catch (const JournalError& error) {
      return error.what();
    }
    return "accepted";
  }
  void Alter(const std::string& sql) const {
    SqliteDatabase(file_, SqliteDatabase::Access::kReadWrite).Execute(sql);
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "team.journal";
};

TEST_F(JournalFileTest, GivesBackWhatWasAppendedInOrderAndEachOnce) {
  Write(5);
  Write(7);
  JournalFile journal = JournalFile::Read(file_, kScanJournal);
  EXPECT_EQ(journal.identity(), "base-1");
  EXPECT_EQ(journal.size(), 7U);
  for (int scan = 1; scan <= 7; ++scan) {
    SCOPED_TRACE(scan);
    const std::optional<JournalEntry> entry = journal.Next();
    ASSERT_TRUE(entry.has_value());
    EXPECT_EQ(entry->sequence, static_cast<std::uint64_t>(scan));
    EXPECT_EQ(entry->stamp, ObservationInRoom(scan).scan.stamp);
    const JournaledScan journaled = DecodeScan(entry->contents);
    EXPECT_EQ(journaled.relevant.scan.ranges_m, ObservationInRoom(scan).scan.ranges_m);
    EXPECT_EQ(journaled.T_odom_robot, ObservationInRoom(scan).T_odom_robot);
  }
  EXPECT_FALSE(journal.Next().has_value());
}

TEST_F(JournalFileTest, IsReadWhileItIsWritten) {
  JournalFile writer = Continue();
  writer.Append(std::vector{EntryOf(1)});
  JournalFile reader = JournalFile::Read(file_, kScanJournal);
  EXPECT_TRUE(reader.Next().has_value());
  writer.Append(std::vector{EntryOf(2)});
  EXPECT_TRUE(reader.Next().has_value());
}

TEST_F(JournalFileTest, BelongsToOneServiceAtATime) {
  const JournalFile first = Continue();
  EXPECT_EQ(Complaint(), file_.string() + ": is in use by another service; each needs its own");
}

TEST_F(JournalFileTest, SaysWhatIsWrongWithForeignAndNewerFiles) {
  std::ofstream(file_)
      << "this is a text of more than a hundred bytes, which SQLite looks at before "
         "it says that it is none of its databases\n";
  EXPECT_EQ(Complaint(), file_.string() + ": is no journal of qwsm");
  std::filesystem::remove(file_);
  Alter("CREATE TABLE messages(id)");
  EXPECT_EQ(Complaint(), file_.string() + ": is an SQLite database, but no journal of qwsm");
  std::filesystem::remove(file_);
  Write(1);
  Alter("PRAGMA user_version = 7");
  EXPECT_EQ(Complaint(),
            file_.string() + ": is a journal of version 7; this release of qwsm reads version 1");
  EXPECT_THROW(JournalFile::Read(folder_.path() / "none", kScanJournal), JournalError);
}

TEST_F(JournalFileTest, RefusesAJournalOfAnotherKind) {
  Write(1);
  EXPECT_THROW(JournalFile::Continue(file_, "another kind", "base-1"), JournalError);
}

TEST_F(JournalFileTest, PassesOverEntriesThatWereAltered) {
  Write(4);
  Alter("UPDATE scan SET stamp_ns = stamp_ns + 1 WHERE position = 2");
  Alter("UPDATE scan SET contents = zeroblob(1000) WHERE position = 3");
  JournalFile journal = Continue();
  EXPECT_EQ(journal.Next()->sequence, 1U);
  EXPECT_EQ(journal.Next()->sequence, 4U);
  EXPECT_EQ(journal.damaged(), 2U);
}

TEST_F(JournalFileTest, TellsOfDamageInsteadOfGivingNonsense) {
  Write(200);
  const std::uintmax_t size = std::filesystem::file_size(file_);
  for (std::uintmax_t at = 100; at < size; at += size / 37) {
    SCOPED_TRACE(at);
    const std::filesystem::path copy = folder_.path() / "damaged.journal";
    std::filesystem::copy_file(file_, copy, std::filesystem::copy_options::overwrite_existing);
    {
      std::fstream stream(copy, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekp(static_cast<std::streamoff>(at));
      stream << std::string(4096, '\xA5');
    }
    std::size_t read = 0;
    std::size_t passed_over = 0;
    try {
      JournalFile journal = JournalFile::Read(copy, kScanJournal);
      while (const std::optional<JournalEntry> entry = journal.Next()) {
        EXPECT_EQ(entry->contents, EntryOf(static_cast<int>(entry->sequence)).contents);
        ++read;
      }
      passed_over = journal.damaged();
    } catch (const JournalError& error) {
      EXPECT_NE(std::string(error.what()).find("damaged.journal: is"), std::string::npos);
      continue;
    }
    EXPECT_LE(read + passed_over, 200U);
  }
}

TEST_F(JournalFileTest, IsReadAsALog) {
  Write(6);
  const std::unique_ptr<LogReader> log = OpenLog(file_);
  for (int scan = 1; scan <= 6; ++scan) {
    const std::optional<LogRecord> record = log->Next();
    ASSERT_TRUE(record.has_value());
    const auto& reading = std::get<ScanReading>(*record);
    EXPECT_EQ(reading.scan.ranges_m, ObservationInRoom(scan).scan.ranges_m);
    EXPECT_EQ(reading.T_odom_robot, test::PoseInRoom(scan));
    EXPECT_EQ(reading.laser, "robot1");
  }
  EXPECT_FALSE(log->Next().has_value());
  EXPECT_EQ(log->report().format, "journal");
  EXPECT_EQ(log->report().scans, 6U);
}

TEST_F(JournalFileTest, IsNotTakenForALogWhenItIsAnotherDatabase) {
  Alter("CREATE TABLE messages(id)");
  EXPECT_THROW(OpenLog(file_), LogError);
}

}  // namespace
}  // namespace qwsm::io
