// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace qwsm::io {

/// A file that is no journal that can be used. The text names it and says why, and how to mend it:
/// foreign, newer, damaged, or in use.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One relevant scan as it is kept: who took it, and its contents in a form the journal does not
/// look into.
struct JournalEntry {
  std::string service;
  std::string robot;
  std::uint64_t sequence = 0;
  std::chrono::nanoseconds stamp{};
  std::string contents;
};

/// Relevant scans on disk, in the order in which the map was extended with them.
///
/// An SQLite database with a write-ahead log, every entry a transaction. Tables:
///   meta(key, value): kind, the kind of contents, and identity, whose journal it is;
///   scan(position, service, robot, sequence, stamp_ns, contents, checksum), where checksum is the
///   CRC-32 of all of the others.
/// PRAGMA application_id is "QWSM", user_version is 1.
class JournalFile {
 public:
  /// Opens a journal to be continued, or begins one.
  /// @param kind of contents: a journal of another kind is refused.
  /// @param identity whose journal it is, if it is new.
  /// @throws JournalError where it is no journal, damaged, or in use; WriteError where it cannot be
  ///         written now but may be later.
  static JournalFile Continue(const std::filesystem::path& file,
                              std::string_view kind,
                              std::string_view identity);
  /// Opens a journal to be read only; another process may be writing it. @throws JournalError
  static JournalFile Read(const std::filesystem::path& file, std::string_view kind);

  JournalFile(JournalFile&&) noexcept;
  JournalFile& operator=(JournalFile&&) noexcept;
  ~JournalFile();

  const std::string& identity() const;
  std::size_t size() const;

  /// Adds entries, each as a transaction. When this returns they are on the disk, whatever then
  /// happens to the process or the power; the disk is waited for once, for all of them. Those that
  /// are there already are passed over.
  /// @throws WriteError where there is no room or no leave to write; none, some or all are added.
  void Append(std::span<const JournalEntry> entries);

  /// The next entry, from the first on. Entries with a wrong checksum are passed over.
  /// @throws JournalError where the file is damaged, after all before the damage was given.
  std::optional<JournalEntry> Next();
  /// Entries passed over so far.
  std::size_t damaged() const;

 private:
  struct State;
  explicit JournalFile(std::unique_ptr<State> state);
  static JournalFile Opened(std::unique_ptr<State> state, std::string_view kind);

  std::unique_ptr<State> state_;
};

}  // namespace qwsm::io
