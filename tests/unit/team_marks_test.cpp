// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Marks on the map: which of an id counts, what they stand on, and how they are kept.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "service/io/files/binary.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/mark_table.hpp"
#include "service/io/journal/sqlite_database.hpp"
#include "service/team/marks/mark_book.hpp"
#include "service/team/marks/mark_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

Mark MarkOf(const std::string& id, Timestamp stamp, const std::string& text = {}) {
  return {.stamp = stamp, .id = id, .kind = "victim", .text = text, .p_map_m = {2.0, 3.0}};
}

TEST(Mark, WhatCannotBeDrawnIsRefused) {
  EXPECT_EQ(ObjectionTo(MarkOf("a", 1s)), "");
  EXPECT_EQ(ObjectionTo(MarkOf("", 1s)), "its id is empty or too long");
  Mark mark = MarkOf("a", 1s);
  mark.p_map_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ObjectionTo(mark), "it lies nowhere");
  mark = MarkOf("a", 1s);
  mark.anchor = {.robot = "r", .stamp = 1s, .p_robot_m = {1e9, 0.0}};
  EXPECT_EQ(ObjectionTo(mark), "it lies nowhere");
}

TEST(MarkBook, OfOneIdTheNewestCounts) {
  MarkBook book;
  EXPECT_TRUE(book.Take(MarkOf("a", 2s, "newer")));
  EXPECT_FALSE(book.Take(MarkOf("a", 1s, "older")));
  EXPECT_FALSE(book.Take(MarkOf("a", 2s, "again")));
  Mark moved = MarkOf("a", 2s, "moved");
  moved.revision = 1;
  EXPECT_TRUE(book.Take(moved));
  EXPECT_EQ(book.marks().front().text, "moved");
}

TEST(MarkBook, HoldsSoManyAndNoMore) {
  MarkBook book;
  for (std::size_t i = 0; i < MarkBook::kMostMarks; ++i) {
    ASSERT_TRUE(book.Take(MarkOf(std::to_string(i), 1s)));
  }
  EXPECT_FALSE(book.Take(MarkOf("one more", 1s)));
  EXPECT_TRUE(book.Take(MarkOf("7", 2s)));
}

TEST(MarkBook, MarksThatWereRemovedGiveWay) {
  MarkBook book;
  for (std::size_t i = 0; i < MarkBook::kMostMarks; ++i) {
    Mark mark = MarkOf(std::to_string(i), 1s * i);
    mark.is_removed = i == 7 || i == 8;
    ASSERT_TRUE(book.Take(mark));
  }
  Mark removed = MarkOf("removed elsewhere", 3000s);
  removed.is_removed = true;
  EXPECT_FALSE(book.Take(removed)) << "or books would go on telling each other of such for ever";
  EXPECT_TRUE(book.Take(MarkOf("one more", 3000s)));
  EXPECT_EQ(book.Find("7"), nullptr);
  ASSERT_NE(book.Find("8"), nullptr);
  EXPECT_TRUE(book.Take(MarkOf("another", 3000s)));
  EXPECT_FALSE(book.HasRoomFor(MarkOf("one too many", 3000s)));
  EXPECT_EQ(book.marks().size(), MarkBook::kMostMarks);
}

TEST(MarkBook, NumbersStay) {
  MarkBook book;
  for (const char* id : {"b", "a", "c"}) book.Take(book.Completed(MarkOf(id, 1s)));
  EXPECT_EQ(book.Completed(MarkOf("a", 2s)).number, 2U);
  EXPECT_EQ(book.Completed(MarkOf("d", 2s)).number, 4U);
}

// Whoever sends an absurd one keeps nobody from marking what comes later.
TEST(MarkBook, NumbersStayLowEnoughToBeSaid) {
  Mark absurd = MarkOf("a", 1s);
  absurd.number = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(ObjectionTo(absurd), "its number is too high");
  Mark highest = MarkOf("b", 1s);
  highest.number = 999'999;
  EXPECT_EQ(ObjectionTo(highest), "");
  MarkBook book;
  book.Take(highest);
  const Mark next = book.Completed(MarkOf("c", 2s));
  EXPECT_EQ(next.number, 1U);
  book.Take(next);
  book.Take(MarkOf("d", 3s));
  ASSERT_EQ(book.NumberApart().size(), 1U);
  EXPECT_EQ(book.marks().back().number, 2U);
}

// Two services that did not hear each other have both given the numbers from 1 on.
TEST(MarkBook, MarksOfSeveralSourcesAreNumberedApart) {
  Mark anna = MarkOf("b", 1s, "Anna");
  Mark bert = MarkOf("a", 2s, "Bert");
  Mark gone = MarkOf("c", 3s);
  anna.number = bert.number = 1;
  gone.number = 7;
  gone.is_removed = true;
  MarkBook one;
  MarkBook other;
  for (const Mark& mark : {anna, bert, gone}) one.Take(mark);
  for (const Mark& mark : {gone, bert, anna, MarkOf("d", 4s)}) other.Take(mark);
  const std::vector<Mark> renumbered = one.NumberApart();
  ASSERT_EQ(renumbered.size(), 1U);
  EXPECT_EQ(renumbered.front().text, "Bert");  // Anna was there before.
  EXPECT_EQ(renumbered.front().number, 8U);    // The number of one that was removed is not free.
  EXPECT_TRUE(Supersedes(renumbered.front(), bert));
  EXPECT_TRUE(one.NumberApart().empty());
  // Others come to the same, and number who has none.
  ASSERT_EQ(other.NumberApart().size(), 2U);
  EXPECT_FALSE(other.Take(renumbered.front()));
  EXPECT_EQ(other.marks().back().number, 9U);
}

TEST(MarkBook, WhoNumbersDifferentlyComesToTheSame) {
  Mark low = MarkOf("a", 1s);
  low.revision = 1;
  low.number = 4;
  Mark high = low;
  high.number = 5;
  for (const auto& [first, second] : {std::pair(low, high), std::pair(high, low)}) {
    MarkBook book;
    book.Take(first);
    book.Take(second);
    EXPECT_EQ(book.marks().front().number, 5U);
  }
}

TEST(Mark, ListsOfSeveralSourcesAreMerged) {
  Mark anna = MarkOf("a", 1s, "Anna");
  Mark bert = MarkOf("b", 2s, "Bert");
  anna.number = bert.number = 1;
  Mark moved = anna;
  moved.revision = 1;
  moved.p_map_m.x() = 9.0;
  const std::vector<Mark> merged = Merged(std::vector<Mark>{anna, bert, moved});
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0].number, 1U);
  EXPECT_EQ(merged[0].p_map_m.x(), 9.0);
  EXPECT_EQ(merged[1].number, 2U);
}

TEST(MarkBook, AMarkGoesWithTheScanItStandsOn) {
  MarkBook book;
  const double quarter_turn_rad = std::numbers::pi / 2.0;
  EXPECT_TRUE(book.Place(std::vector<ScanPlace>{
                             {.robot = "near", .stamp = 5s, .T_map_robot = {2.0, 2.0, 0.0}},
                             {.robot = "far", .stamp = 5s, .T_map_robot = {9.0, 9.0, 0.0}}})
                  .empty());
  const Mark mark = book.Completed(MarkOf("a", 1s));
  ASSERT_TRUE(mark.anchor);
  EXPECT_EQ(mark.anchor->robot, "near");
  book.Take(mark);
  // The other scan, and this one again where it was, move nothing.
  EXPECT_TRUE(book.Place(std::vector<ScanPlace>{
                             {.robot = "near", .stamp = 5s, .T_map_robot = {2.0, 2.0, 0.0}},
                             {.robot = "far", .stamp = 5s, .T_map_robot = {0.0, 9.0, 0.0}}})
                  .empty());
  const std::vector<Mark> moved = book.Place(std::vector<ScanPlace>{
      {.robot = "near", .stamp = 5s, .T_map_robot = {4.0, 2.0, quarter_turn_rad}}});
  ASSERT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved.front().revision, 1U);
  EXPECT_NEAR((moved.front().p_map_m - Eigen::Vector2d(3.0, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(Supersedes(moved.front(), mark));
}

TEST(MarkBook, WithoutAMapAMarkStaysWhereItIs) {
  const MarkBook book;
  EXPECT_FALSE(book.Completed(MarkOf("a", 1s)).anchor);
}

class MarkJournalTest : public ::testing::Test {
 protected:
  MarkJournal Open() {
    return {file_, [this](const std::string& text) { told_.push_back(text); }};
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "team.db";
  std::vector<std::string> told_;
};

TEST_F(MarkJournalTest, KeepsMarksBesideTheScans) {
  const auto journal = io::JournalFile::Continue(file_, "scans", "base");
  Mark mark = MarkOf("a", 1s, "\xff Anna");
  mark.number = 7;
  mark.anchor = {.robot = "robot1", .stamp = 5s, .p_robot_m = {0.5, -0.25}};
  Open().Keep({mark, MarkOf("b", 1s)});
  mark.revision = 3;
  Open().Keep({mark});
  const std::vector<Mark> kept = Open().Load();
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(EncodeMark(kept.front()), EncodeMark(mark));
  EXPECT_TRUE(told_.empty());
}

TEST_F(MarkJournalTest, WhatCannotBeWrittenIsWrittenLater) {
  MarkJournal marks = Open();
  marks.Keep({MarkOf("a", 1s)});
  marks.Keep({MarkOf("b", 1s)});
  EXPECT_EQ(told_.size(), 1U);
  const auto journal = io::JournalFile::Continue(file_, "scans", "base");
  EXPECT_TRUE(marks.is_behind());
  marks.Keep({});
  EXPECT_FALSE(marks.is_behind());
  EXPECT_EQ(Open().Load().size(), 2U);
  marks.Keep({MarkOf("c", 1s)});
  EXPECT_EQ(Open().Load().size(), 3U);
}

TEST_F(MarkJournalTest, WhatIsDamagedIsToldAndLeftOut) {
  const auto journal = io::JournalFile::Continue(file_, "scans", "base");
  Open().Keep({MarkOf("a", 1s), MarkOf("b", 1s)});
  io::SqliteDatabase database(file_, io::SqliteDatabase::Access::kReadWrite);
  database.Execute("UPDATE mark SET contents = x'00' WHERE id = 'a'");
  EXPECT_EQ(Open().Load().size(), 1U);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_NE(told_.front().find("team.db: 1 marks are damaged"), std::string::npos);
}

TEST_F(MarkJournalTest, BytesThatAreNoMarkAreTold) {
  const std::string bytes = EncodeMark(MarkOf("a", 1s));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(static_cast<void>(DecodeMark(bytes.substr(0, size))), io::BinaryError);
  }
}

}  // namespace
}  // namespace qwsm::team
