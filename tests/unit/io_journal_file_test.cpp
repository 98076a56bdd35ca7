// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/mark_table.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "tests/support/program.hpp"
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

void FlipBit(const std::filesystem::path& file, std::uintmax_t at, unsigned bit) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(at));
  const int byte = stream.get();
  stream.seekp(static_cast<std::streamoff>(at));
  stream.put(static_cast<char>(byte ^ (1 << bit)));
}

/// Reads a file that may be damaged: either that is told, or each of its `entries` entries is given
/// as it was or counted as lost. @return how many were given.
std::size_t ExpectSoundReading(const std::filesystem::path& file, std::size_t entries) {
  std::size_t given = 0;
  try {
    JournalFile journal = JournalFile::Read(file, kScanJournal);
    while (const std::optional<JournalEntry> entry = journal.Next()) {
      EXPECT_EQ(entry->contents, EntryOf(static_cast<int>(entry->sequence)).contents);
      if (++given > entries) break;  // It would go on for ever.
    }
    EXPECT_EQ(given + journal.damaged(), entries);
  } catch (const JournalError& error) {
    EXPECT_NE(std::string(error.what()).find(file.filename().string() + ": is"), std::string::npos);
  }
  return given;
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

  std::filesystem::path Copy() const {
    std::filesystem::path copy = folder_.path() / "copy.journal";
    std::filesystem::copy_file(file_, copy, std::filesystem::copy_options::overwrite_existing);
    return copy;
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

TEST_F(JournalFileTest, BelongsToOneServiceByWhateverName) {
  const JournalFile used = Continue();
  const std::filesystem::path link = folder_.path() / "link.journal";
  std::filesystem::create_symlink(file_, link);
  EXPECT_THROW(JournalFile::Continue(link, kScanJournal, "base-2"), JournalError);
}

TEST_F(JournalFileTest, IsDamagedWhereATableIsMissing) {
  Write(3);
  Alter("DROP TABLE meta");
  const std::string damaged = file_.string() + ": is damaged: no such table: meta";
  EXPECT_EQ(Complaint().substr(0, damaged.size()), damaged);
  try {
    JournalFile::Read(file_, kScanJournal);
    ADD_FAILURE() << "accepted";
  } catch (const JournalError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, damaged.size()), damaged);
  }
}

TEST_F(JournalFileTest, IsWrittenAnewWhereItWasRemoved) {
  Write(20);
  JournalFile journal = Continue();
  KeepMarks(file_, std::vector<KeptMark>{{.id = "a", .contents = "a mark"}});
  journal.Append(std::vector{EntryOf(21)});
  EXPECT_TRUE(journal.IsInPlace());
  for (const char* part : {"", "-wal", "-shm", ".lock"}) {
    std::filesystem::remove(file_.string() + part);
  }
  EXPECT_FALSE(journal.IsInPlace());
  journal.WriteAnew(kScanJournal);
  EXPECT_TRUE(journal.IsInPlace());
  journal.Append(std::vector{EntryOf(22)});
  EXPECT_EQ(ExpectSoundReading(file_, 22), 22U);
  EXPECT_EQ(journal.identity(), "base-1");
  EXPECT_EQ(Complaint(), file_.string() + ": is in use by another service; each needs its own");
  std::size_t damaged_marks = 0;
  EXPECT_EQ(ReadMarks(file_, damaged_marks), std::vector<std::string>{"a mark"});
}

TEST_F(JournalFileTest, IsNotWrittenOverAnotherFile) {
  Write(5);
  JournalFile journal = Continue();
  std::filesystem::rename(file_, folder_.path() / "moved.journal");
  std::ofstream(file_) << "another one";
  EXPECT_THROW(journal.WriteAnew(kScanJournal), JournalError);
  std::filesystem::remove(file_);
  journal.WriteAnew(kScanJournal);
  EXPECT_EQ(ExpectSoundReading(file_, 5), 5U);
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

TEST_F(JournalFileTest, GivesWhatIsGoodBeforeAndBehindDamageAndCountsWhatIsLost) {
  Write(200);
  const std::uintmax_t size = std::filesystem::file_size(file_);
  for (std::uintmax_t at = 100; at < size; at += size / 37) {
    SCOPED_TRACE(at);
    const std::filesystem::path copy = Copy();
    {
      std::fstream stream(copy, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekp(static_cast<std::streamoff>(at));
      stream << std::string(4096, '\xA5');
    }
    if (at >= 4 * 4096) {  // Behind the head, the index and the roots.
      EXPECT_GT(ExpectSoundReading(copy, 200), 150U);
    } else {
      ExpectSoundReading(copy, 200);
    }
  }
}

TEST_F(JournalFileTest, ReadingEndsAndKeepsWhatIsGoodWhicheverByteIsFlipped) {
  Write(200);
  const std::uintmax_t size = std::filesystem::file_size(file_);
  std::mt19937 random(11);
  int readable = 0;
  for (int flip = 0; flip < 200; ++flip) {
    // Every other one in the head of a page, where its kind, its cells and its neighbour stand.
    const std::uintmax_t anywhere = random() % size;
    const std::uintmax_t at = flip % 2 == 0 ? anywhere : anywhere / 4096 * 4096 + random() % 32;
    SCOPED_TRACE(at);
    const std::filesystem::path copy = Copy();
    FlipBit(copy, at, random() % 8);
    if (ExpectSoundReading(copy, 200) > 0) ++readable;
  }
  EXPECT_GT(readable, 190);  // The others are flipped where it says what it is.
}

TEST_F(JournalFileTest, GoesOnBehindDamageInANewFileAndKeepsTheDamagedOne) {
  Write(200);
  const std::filesystem::path copy = Copy();
  KeepMarks(copy, std::vector<KeptMark>{{.id = "a", .contents = "a mark"}});
  {  // A page of entries that says it was a page of the index.
    std::fstream stream(copy, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(copy) / 4096 / 2 * 4096));
    stream.put('\x0A');
  }
  const std::string as_it_was = test::ReadFile(copy);
  std::size_t kept = 0;
  {
    JournalFile journal = JournalFile::Continue(copy, kScanJournal, "base-2");
    kept = journal.size();
    EXPECT_LT(kept, 200U);
    EXPECT_EQ(kept + journal.damaged(), 200U);
    EXPECT_EQ(journal.identity(), "base-1");
    EXPECT_EQ(test::ReadFile(journal.damaged_copy()), as_it_was);
    journal.Append(std::vector{EntryOf(201)});
  }
  JournalFile journal = JournalFile::Continue(copy, kScanJournal, "base-2");
  EXPECT_TRUE(journal.damaged_copy().empty());
  EXPECT_EQ(journal.damaged(), 0U);
  EXPECT_EQ(ExpectSoundReading(copy, kept + 1), kept + 1);
  std::size_t damaged_marks = 0;
  EXPECT_EQ(ReadMarks(copy, damaged_marks), std::vector<std::string>{"a mark"});
}

TEST_F(JournalFileTest, IsMendedWhileSomebodyReadsIt) {
  Write(200);
  const std::filesystem::path copy = Copy();
  {
    std::fstream stream(copy, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(std::filesystem::file_size(copy) / 4096 / 2 * 4096));
    stream.put('\x0A');
  }
  JournalFile reader = JournalFile::Read(copy, kScanJournal);
  ASSERT_TRUE(reader.Next().has_value());
  std::size_t kept = 0;
  {
    JournalFile journal = JournalFile::Continue(copy, kScanJournal, "base-2");
    journal.Append(std::vector{EntryOf(201)});
    kept = journal.size();
  }
  while (reader.Next()) {
  }
  EXPECT_EQ(ExpectSoundReading(copy, kept), kept);
}

// SQLite puts what follows the highest position there is at a random one.
TEST_F(JournalFileTest, FindsWhatWasAppendedBehindAPositionThatWasAltered) {
  const std::vector<JournalEntry> entries = {EntryOf(1), EntryOf(2), EntryOf(3)};
  Continue().Append(entries);
  for (const std::string position : {"9223372036854775807", "1000000000"}) {
    SCOPED_TRACE(position);
    Alter("UPDATE scan SET position = " + position +
          " WHERE position = (SELECT max(position) FROM scan)");
    Continue().Append(std::vector{EntryOf(4)});
    std::vector<std::uint64_t> found;
    JournalFile journal = JournalFile::Read(file_, kScanJournal);
    while (const auto entry = journal.Next()) found.push_back(entry->sequence);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.back(), 4U);
    EXPECT_EQ(found.front(), 1U);
  }
}

// One that says that the next entry is there already.
TEST_F(JournalFileTest, FindsWhatWasAppendedBehindAnIndexThatWasAltered) {
  Continue().Append(std::vector{EntryOf(1), EntryOf(2), EntryOf(3)});
  std::string bytes = test::ReadFile(file_);
  const JournalEntry last = EntryOf(3);
  const std::size_t key = bytes.find(last.service + last.robot + "\x03\x03");
  ASSERT_NE(key, std::string::npos);
  bytes[key + last.service.size() + last.robot.size()] = '\x04';
  std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;

  Continue().Append(std::vector{EntryOf(4)});
  EXPECT_EQ(ExpectSoundReading(file_, 4), 4U);
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
