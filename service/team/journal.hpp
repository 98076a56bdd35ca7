// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "service/io/journal_file.hpp"
#include "service/team/team_status.hpp"

namespace qwsm::team {

/// Keeps relevant scans on disk, in a thread of its own: whoever appends never waits for the disk.
/// While the disk is full or may not be written, entries wait in memory and are tried again; none
/// is given up. Knows nothing of what the scans are.
class Journal {
 public:
  struct Names {
    std::filesystem::path file;
    std::string kind;      ///< Of contents.
    std::string identity;  ///< If the journal is new.
  };

  /// Opens the journal, or begins one. One that cannot be written now is tried again later.
  /// @throws io::JournalError where it is no journal, is damaged, or in use.
  explicit Journal(Names names);
  /// Stops.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Whose journal it is.
  const std::string& identity() const { return names_.identity; }

  /// Gives every entry that was in the file when it was opened to `take`, in order, and begins to
  /// store. To be called once. @return entries that were damaged.
  std::size_t Restore(const std::function<void(io::JournalEntry)>& take);

  /// Stores the entry, later. @param settled is called once it is safely on disk, or has to wait
  /// for a disk that cannot be written; once for each entry, in their order.
  void Append(io::JournalEntry entry, const std::function<void()>& settled);

  /// Stores what waits, unless the disk cannot be written, and then nothing more.
  void Stop();
  /// Waits until all is stored, or nothing can be.
  void WaitUntilSettled();
  JournalStatus Status() const;

 private:
  struct Waiting {
    io::JournalEntry entry;
    std::function<void()> settled;
  };

  void Work(const std::stop_token& stop);
  bool StoreOldest();
  std::vector<io::JournalEntry> OldestEntries() const;
  void Fail(const std::string& trouble);
  void Reopen();

  Names names_;
  std::optional<io::JournalFile> file_;  // Of the thread, once it runs. None where it cannot be.

  mutable std::mutex mutex_;  // Guards what follows.
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;  // An entry stays until it is stored.
  std::string trouble_;
  std::uint64_t stored_ = 0;

  std::jthread thread_;  // Last: it uses all of the above.
};

}  // namespace qwsm::team
