// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/journal/journal_table.hpp"

#include <sqlite3.h>

#include <algorithm>

#include "service/io/files/binary.hpp"

namespace qwsm::io {
namespace {

constexpr std::int64_t kLeastBytesOfEntry = 16;  // Its row's head, rowid, numbers and checksum.

std::int64_t ChecksumOf(const JournalEntry& entry) {
  BinaryWriter bytes;
  bytes.Add(entry.service);
  bytes.Add(entry.robot);
  bytes.Add(entry.sequence);
  bytes.Add(static_cast<std::int64_t>(entry.stamp.count()));
  bytes.Add(entry.contents);
  return Checksum(bytes.bytes());
}

}  // namespace

void JournalTable::Create(SqliteDatabase& database) {
  database.Execute(
      "CREATE TABLE scan(position INTEGER PRIMARY KEY, service TEXT NOT NULL, robot TEXT NOT NULL,"
      " sequence INTEGER NOT NULL, stamp_ns INTEGER NOT NULL, contents BLOB NOT NULL,"
      " checksum INTEGER NOT NULL, UNIQUE(service, robot, sequence));");
}

std::optional<std::int64_t> JournalTable::NumberUnlessDamaged(std::string_view sql) {
  try {
    return database_.Number(sql);
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CORRUPT) throw;
    return std::nullopt;
  }
}

// That the bytes of the file can hold.
std::int64_t JournalTable::MostEntries() {
  return database_.Number("PRAGMA page_count") * database_.Number("PRAGMA page_size") /
         kLeastBytesOfEntry;
}

bool JournalTable::CanGrow() {
  const auto last = NumberUnlessDamaged("SELECT max(rowid) FROM scan");
  return last && *last <= MostEntries();
}

JournalTable::Extent JournalTable::Measure() {
  const std::int64_t most = MostEntries();
  // The one is counted in the index, the other stands at the end of the table: one of them may be
  // damaged and the other not.
  const auto count = NumberUnlessDamaged("SELECT count(*) FROM scan");
  const auto last = NumberUnlessDamaged("SELECT max(rowid) FROM scan");
  if (!count && !last) return {.claimed = std::nullopt, .last_position = most};
  const std::int64_t reach = std::max(count.value_or(0), last.value_or(0));
  return {.claimed = std::min(count ? *count : *last, most),
          .last_position = std::min(reach, most)};
}

void JournalTable::Insert(const JournalEntry& entry) {
  if (!insert_) {
    insert_ = database_.Prepare(
        "INSERT OR IGNORE INTO scan(service, robot, sequence, stamp_ns, contents, checksum)"
        " VALUES(?, ?, ?, ?, ?, ?)");
  }
  insert_->Reset();
  insert_->Bind(1, entry.service);
  insert_->Bind(2, entry.robot);
  insert_->Bind(3, static_cast<std::int64_t>(entry.sequence));
  insert_->Bind(4, static_cast<std::int64_t>(entry.stamp.count()));
  insert_->BindBlob(5, entry.contents);
  insert_->Bind(6, ChecksumOf(entry));
  insert_->Step();
  insert_->Reset();
}

std::optional<JournalEntry> JournalTable::Find(std::int64_t position) {
  try {
    if (!find_) {
      find_ = database_.Prepare(
          "SELECT service, robot, sequence, stamp_ns, contents, checksum FROM scan"
          " WHERE rowid = ?");
    }
    find_->Reset();
    find_->Bind(1, position);
    if (!find_->Step()) return std::nullopt;
    JournalEntry entry{.service = find_->Text(0),
                       .robot = find_->Text(1),
                       .sequence = static_cast<std::uint64_t>(find_->Integer(2)),
                       .stamp = std::chrono::nanoseconds(find_->Integer(3)),
                       .contents = std::string(find_->Blob(4))};
    const bool is_intact = ChecksumOf(entry) == find_->Integer(5);
    find_->Reset();  // An open statement would keep the log from being tidied up.
    if (is_intact) return entry;
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_CORRUPT) throw;
  }
  return std::nullopt;
}

}  // namespace qwsm::io
