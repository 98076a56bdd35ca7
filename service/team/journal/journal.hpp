// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "service/io/journal/journal_file.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

/// Keeps relevant scans on disk, in a thread of its own: whoever appends never waits for the disk,
/// and what is to be told of an entry is told once it is safe. What has come meanwhile is stored
/// together, so a slow disk is waited for less often, not longer.
///
/// While the disk is full or may not be written, entries wait in memory and are tried again; none
/// is given up. Knows nothing of what the scans are.
class Journal {
 public:
  struct Names {
    std::filesystem::path file;
    std::string kind;      ///< Kind of the contents.
    std::string identity;  ///< Identity that a new journal gets.
  };

  /// Takes what a person should know of the journal; called by any of its threads.
  using Tell = std::function<void(bool is_warning, const std::string& text)>;

  /// Opens the journal, or begins one. One that cannot be written now is tried again later.
  /// @throws io::JournalError where it is no journal, in use, or so damaged that it says nothing.
  Journal(Names names, Tell tell);
  /// Stops as Stop() does.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Name of the service whose journal it is.
  const std::string& identity() const { return names_.identity; }

  /// What a damaged file has lost.
  struct Loss {
    std::size_t entries = 0;
    /// Where the damaged file was put, if it had to be made anew.
    std::filesystem::path damaged_copy;
  };
  /// Gives every entry that was in the file when it was opened to `take`, in order, and begins to
  /// store. To be called once.
  Loss Restore(const std::function<void(io::JournalEntry)>& take);

  /// Stores the entry, later. @param settled is called once it is safely on disk, or has to wait
  /// for a disk that cannot be written.
  void Append(io::JournalEntry entry, std::function<void()> settled);
  /// Calls `tell` once all that was appended before is settled. What is told keeps its order.
  void TellWhenSettled(std::function<void()> tell);

  /// Stores what waits, unless the disk cannot be written, and tells it; works no more afterwards.
  void Stop();
  /// Waits until all entries are stored, or none can be, and told.
  void WaitUntilSettled();
  JournalStatus Status() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Order {
    std::optional<io::JournalEntry> entry;
    std::function<void()> settled;
  };

  void Take(Order order);
  void Work(const std::stop_token& stop);
  std::vector<Order> WaitForOrders(const std::stop_token& stop);
  void Store();
  void Open();
  void PutInPlace();
  void Fail(const std::string& trouble);
  void Conclude(std::size_t stored, const std::string& trouble);

  Names names_;
  const Tell tell_;

  mutable std::mutex mutex_;  // Guards what follows.
  std::condition_variable_any changed_;
  std::vector<Order> orders_;
  bool is_settling_ = false;  // Whether orders that were taken from the list are still at work.
  std::string trouble_;
  std::uint64_t stored_ = 0;
  std::uint64_t waiting_ = 0;

  // The thread alone uses these, once it runs.
  std::optional<io::JournalFile> file_;  // None where it cannot be.
  std::vector<io::JournalEntry> unstored_;
  Clock::time_point next_try_{};  // When a disk that cannot be written is tried again.

  std::jthread thread_;  // Last: it uses all members above.
};

}  // namespace qwsm::team
