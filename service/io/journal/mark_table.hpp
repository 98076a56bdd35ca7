// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "service/io/journal/sqlite_database.hpp"

namespace qwsm::io {

/// A mark on the map as it is kept, in a form the journal does not look into.
struct KeptMark {
  std::string id;
  std::string contents;
};

/// The marks of a journal in its database: mark(id, contents, checksum), where checksum is the
/// CRC-32 of the contents. A journal without marks need not have the table.
class MarkTable {
 public:
  /// Uses the table. @param database must outlive it. All functions throw SqliteError.
  explicit MarkTable(SqliteDatabase& database) : database_(database) {}

  /// Puts marks in the places of those of their ids, all or none. Makes the table if need be.
  void Put(std::span<const KeptMark> marks);
  /// All marks that can be read. @param damaged counts those that cannot, as far as is known.
  std::vector<KeptMark> All(std::size_t& damaged);

 private:
  SqliteDatabase& database_;
};

/// The contents of the marks of a journal, which may be in use.
/// @param damaged counts those that cannot be read.
/// @throws JournalError where it is no journal.
std::vector<std::string> ReadMarks(const std::filesystem::path& journal, std::size_t& damaged);

/// Keeps marks in a journal that is there already, and may be in use by this process.
/// @throws WriteError where that cannot be done now, JournalError where it is no journal.
void KeepMarks(const std::filesystem::path& journal, std::span<const KeptMark> marks);

}  // namespace qwsm::io
