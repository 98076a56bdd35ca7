// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/mark_table.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/binary.hpp"
#include "service/io/journal/journal_file.hpp"

namespace qwsm::io {
namespace {

// More than any book of marks holds: a table that claims more is damaged.
constexpr std::size_t kMostKeptMarks = 100'000;

/// Whether there is a table of marks, as far as a damaged database tells.
bool HasMarks(SqliteDatabase& database) {
  try {
    return database.Number("SELECT count(*) FROM sqlite_master WHERE name = 'mark'") > 0;
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CORRUPT) throw;
    return false;
  }
}

void CheckIsJournal(SqliteDatabase& database, const std::filesystem::path& journal) {
  if (database.Number("PRAGMA application_id") == kJournalApplicationId) return;
  throw JournalError(journal.string() + ": is no journal of qwsm");
}

}  // namespace

void MarkTable::Put(std::span<const KeptMark> marks) {
  if (marks.empty()) return;
  database_.Execute(
      "CREATE TABLE IF NOT EXISTS mark(id TEXT PRIMARY KEY, contents BLOB NOT NULL,"
      " checksum INTEGER NOT NULL)");
  SqliteStatement put = database_.Prepare("INSERT OR REPLACE INTO mark VALUES(?, ?, ?)");
  database_.Execute("BEGIN IMMEDIATE");
  try {
    for (const KeptMark& mark : marks) {
      put.Bind(1, mark.id);
      put.BindBlob(2, mark.contents);
      put.Bind(3, static_cast<std::int64_t>(Checksum(mark.contents)));
      put.Step();
      put.Reset();
    }
    database_.Execute("COMMIT");
  } catch (const SqliteError&) {
    database_.RollBack();
    throw;
  }
}

std::vector<KeptMark> MarkTable::All(std::size_t& damaged) {
  std::vector<KeptMark> marks;
  if (!HasMarks(database_)) return marks;
  SqliteStatement all = database_.Prepare("SELECT id, contents, checksum FROM mark");
  try {
    // Pages of a damaged table may point at each other.
    for (std::size_t row = 0; row < kMostKeptMarks && all.Step(); ++row) {
      KeptMark mark{.id = all.Text(0), .contents = std::string(all.Blob(1))};
      if (Checksum(mark.contents) == all.Integer(2)) {
        marks.push_back(std::move(mark));
      } else {
        ++damaged;
      }
    }
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CORRUPT) throw;
    ++damaged;
  }
  std::ranges::sort(marks, {}, &KeptMark::id);
  return marks;
}

std::vector<std::string> ReadMarks(const std::filesystem::path& journal, std::size_t& damaged) {
  try {
    SqliteDatabase database(journal, SqliteDatabase::Access::kReadOnly);
    CheckIsJournal(database, journal);
    std::vector<std::string> contents;
    for (KeptMark& mark : MarkTable(database).All(damaged)) {
      contents.push_back(std::move(mark.contents));
    }
    return contents;
  } catch (const SqliteError& error) {
    throw JournalError(journal.string() + ": " + error.what());
  }
}

void KeepMarks(const std::filesystem::path& journal, std::span<const KeptMark> marks) {
  // Without its service's tables the file would be no journal.
  if (!std::filesystem::exists(journal)) throw WriteError(journal.string() + ": is not there yet");
  try {
    SqliteDatabase database(journal, SqliteDatabase::Access::kReadWrite);
    CheckIsJournal(database, journal);
    MarkTable(database).Put(marks);
  } catch (const SqliteError& error) {
    throw WriteError(journal.string() + ": " + error.what());
  }
}

}  // namespace qwsm::io
