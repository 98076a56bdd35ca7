// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/journal/service_journal.hpp"

#include <fmt/format.h>

#include <optional>
#include <random>
#include <utility>

#include "service/io/files/binary.hpp"

namespace qwsm::team {

ServiceJournal::ServiceJournal(const std::string& service, const Place& place, TellEvent tell)
    : tell_(std::move(tell)), identity_(fmt::format("{}-{:08x}", service, std::random_device{}())) {
  if (place.file.empty()) return;
  journal_ = std::make_unique<Journal>(
      Journal::Names{.file = place.file, .kind = std::string(place.kind), .identity = identity_},
      [this](bool is_warning, const std::string& text) {
        tell_({.robot = std::nullopt, .is_warning = is_warning, .text = text});
      });
}

void ServiceJournal::Restore(const std::function<void(const io::JournalEntry&)>& take) {
  if (!journal_) return;
  std::size_t unreadable = 0;
  const Journal::Loss loss = journal_->Restore([&](const io::JournalEntry& entry) {
    try {
      take(entry);
    } catch (const io::BinaryError&) {
      ++unreadable;
    }
  });
  identity_ = journal_->identity();
  const std::string file = journal_->Status().file;
  if (!loss.damaged_copy.empty()) {
    Warn(
        fmt::format("{}: was damaged and is made anew of what is good in it; as it was it is kept "
                    "as {}",
                    file,
                    loss.damaged_copy.string()));
  }
  if (loss.entries + unreadable == 0) return;
  Warn(fmt::format("{}: {} entries are damaged and left out", file, loss.entries + unreadable));
}

void ServiceJournal::TellWhenSafe(std::function<void()> tell) {
  if (!journal_) return tell();
  journal_->TellWhenSettled(std::move(tell));
}

void ServiceJournal::Stop() {
  if (!journal_) return;
  journal_->Stop();
  const JournalStatus journal = journal_->Status();
  if (journal.waiting == 0) return;
  Warn(fmt::format("{} scans could not be stored: {}", journal.waiting, journal.trouble));
}

void ServiceJournal::WaitUntilSettled() {
  if (journal_) journal_->WaitUntilSettled();
}

JournalStatus ServiceJournal::Status() const {
  return journal_ ? journal_->Status() : JournalStatus{};
}

void ServiceJournal::Warn(const std::string& text) const {
  tell_({.robot = std::nullopt, .is_warning = true, .text = text});
}

}  // namespace qwsm::team
