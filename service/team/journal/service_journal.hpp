// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "service/team/journal/journal.hpp"
#include "service/team/sinks/service_sink.hpp"

namespace qwsm::team {

/// The journal of a service, where it has one, and the name under which its scans are known: that
/// of the options and a random number, which the journal keeps. So a service that comes back with
/// its memory goes on under its name, and one without does not take the name of another.
class ServiceJournal {
 public:
  /// Where the scans are kept; with an empty file they are not.
  struct Place {
    std::filesystem::path file;
    std::string_view kind;  ///< Kind of the journal's contents.
  };

  /// Opens the journal, if there is to be one.
  /// @param tell takes what a person should know.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  ServiceJournal(const std::string& service, const Place& place, TellEvent tell);

  const std::string& identity() const { return identity_; }
  /// Whether there is a journal that keeps scans.
  explicit operator bool() const { return journal_ != nullptr; }

  /// Gives every entry that was kept to `take`, in order; one that `take` throws io::BinaryError
  /// about is damaged, and left out as those are that the file itself knows to be. To be called
  /// once, before the functions below.
  void Restore(const std::function<void(const io::JournalEntry&)>& take);

  /// Keeps an entry, see Journal::Append(). @pre there is a journal.
  void Append(io::JournalEntry entry, std::function<void()> settled) {
    journal_->Append(std::move(entry), std::move(settled));
  }
  /// Calls `tell` once all that was appended before is safe; at once where nothing is kept.
  void TellWhenSafe(std::function<void()> tell);

  /// Stores what waits, and tells of what cannot be stored.
  void Stop();
  void WaitUntilSettled();
  JournalStatus Status() const;

 private:
  void Warn(const std::string& text) const;

  const TellEvent tell_;
  std::string identity_;
  std::unique_ptr<Journal> journal_;  // Null where there is no journal.
};

}  // namespace qwsm::team
