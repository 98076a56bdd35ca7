// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "service/io/journal/journal_entry.hpp"

namespace qwsm::io {

/// By which SQLite's tools, and we, know a journal: "QWSM".
inline constexpr std::int64_t kJournalApplicationId = 0x5157534D;

/// Tells of a file that is no journal that can be used. The text names it and says why, and how to
/// mend it: foreign, newer, damaged, or in use.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Keeps relevant scans on disk, in the order in which the map was extended with them.
///
/// An SQLite database with a write-ahead log, every entry a transaction. Tables:
///   meta(key, value): kind, the kind of contents, and identity, whose journal it is;
///   scan: the entries, see JournalTable;
///   mark: marks on the map, if there are any, see MarkTable.
/// PRAGMA application_id is "QWSM", user_version is 1.
///
/// Of a damaged file what is good is given, and what is lost is counted.
class JournalFile {
 public:
  /// Opens a journal to be continued, or begins one. One whose pages are damaged is not written on:
  /// what is good of it is put into a new file in its place, and it is kept under another name.
  /// @param kind of contents: a journal of another kind is refused.
  /// @param identity whose journal it is, if it is new.
  /// @throws JournalError where it is no journal, in use, or so damaged that nothing can be read;
  ///         WriteError where it cannot be written now but may be later.
  static JournalFile Continue(const std::filesystem::path& file,
                              std::string_view kind,
                              std::string_view identity);
  /// Opens a journal to be read only; another process may be writing it. @throws JournalError
  static JournalFile Read(const std::filesystem::path& file, std::string_view kind);

  JournalFile(JournalFile&&) noexcept;
  JournalFile& operator=(JournalFile&&) noexcept;
  ~JournalFile();

  const std::string& identity() const;
  /// Number of entries; of a damaged journal, the number it says it has.
  std::size_t size() const;

  /// Adds entries, each as a transaction. When this returns they are on the disk, whatever then
  /// happens to the process or the power; the disk is waited for once, for all of them. Those that
  /// are there already are passed over.
  /// @throws WriteError where there is no room or no leave to write; none, some or all are added.
  void Append(std::span<const JournalEntry> entries);

  /// Whether the file is still the one that was opened: somebody may have removed or moved it.
  bool IsInPlace() const;
  /// Puts all that is in it into a new file of its name. @pre it is open to be continued, and not
  /// in its place any more.
  /// @throws JournalError where another file is in its place, WriteError where none can be written
  /// now; it stays as it is then.
  void WriteAnew(std::string_view kind);

  /// Gives the next entry, from the first on. Damaged ones are passed over.
  /// @throws JournalError where none can be read.
  std::optional<JournalEntry> Next();
  /// Number of entries known to be lost so far.
  std::size_t damaged() const;
  /// Where a file was put that was too damaged to be continued; empty if there was none.
  const std::filesystem::path& damaged_copy() const;

 private:
  struct State;
  explicit JournalFile(std::unique_ptr<State> state);
  static JournalFile Opened(std::unique_ptr<State> state, std::string_view kind);
  static JournalFile OpenToWrite(const std::filesystem::path& file,
                                 std::string_view kind,
                                 std::string_view identity);
  std::size_t CopyTo(const std::filesystem::path& file, std::string_view kind);
  static JournalFile Mended(JournalFile damaged, std::string_view kind);

  std::unique_ptr<State> state_;
};

}  // namespace qwsm::io
