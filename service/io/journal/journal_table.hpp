// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "service/io/journal/journal_entry.hpp"
#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {

/// The entries of a journal in its database, numbered from 1 in the order in which they came:
///   scan(position, service, robot, sequence, stamp_ns, contents, checksum), where checksum is the
///   CRC-32 of all of the others but the position.
///
/// Entries are looked up, each by its position, and never walked along: of a damaged file whose
/// pages point at each other a walk may have no end, while a look-up goes down the tree once. So
/// what the damage has not touched is found, too, before it and behind it.
class JournalTable {
 public:
  /// Makes the table. @throws SqliteError, as all functions of the class do.
  static void Create(SqliteDatabase& database);
  /// Uses a table. @param database must outlive it, and have the table.
  explicit JournalTable(SqliteDatabase& database) : database_(database) {}

  /// How far entries may reach in a table.
  struct Extent {
    /// Number of entries that the table says it has; nothing where that cannot be read.
    std::optional<std::int64_t> claimed;
    /// Position where looking ends. No more than the bytes of the file can hold.
    std::int64_t last_position = 0;
  };
  Extent Measure();
  /// Whether what is added will be found: behind a position that is damaged and beyond what the file
  /// can hold SQLite would put it anywhere.
  bool CanGrow();

  /// Adds an entry behind the last one, unless it is there already.
  void Insert(const JournalEntry& entry);
  /// The entry at a position; nothing where there is none, or where it is damaged.
  std::optional<JournalEntry> Find(std::int64_t position);
  /// Lets go of an insertion that has failed.
  void GiveUpInsertion() { insert_.reset(); }

 private:
  std::int64_t MostEntries();
  std::optional<std::int64_t> NumberUnlessDamaged(std::string_view sql);

  SqliteDatabase& database_;
  std::optional<SqliteStatement> insert_;
  std::optional<SqliteStatement> find_;
};

}  // namespace qwsm::io
