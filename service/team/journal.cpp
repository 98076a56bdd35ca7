// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/journal.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "service/io/atomic_file.hpp"

namespace qwsm::team {
namespace {

// How often a disk that cannot be written is tried again.
constexpr std::chrono::milliseconds kRetryPeriod{500};
// Entries that the disk is waited for together.
constexpr std::size_t kBatch = 64;

}  // namespace

Journal::Journal(Names names) : names_(std::move(names)) {
  Reopen();
  if (file_) names_.identity = file_->identity();
}

Journal::~Journal() { Stop(); }

void Journal::Stop() {
  {
    const std::lock_guard lock(mutex_);
    thread_.request_stop();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Journal::Reopen() {
  file_.reset();
  try {
    file_ = io::JournalFile::Continue(names_.file, names_.kind, names_.identity);
  } catch (const io::WriteError& error) {
    Fail(error.what());
  }
}

std::size_t Journal::Restore(const std::function<void(io::JournalEntry)>& take) {
  std::size_t damaged = 0;
  std::optional<io::JournalFile> read_only;
  std::error_code error;
  if (!file_ && std::filesystem::exists(names_.file, error)) {
    read_only = io::JournalFile::Read(names_.file, names_.kind);
    names_.identity = read_only->identity();
  }
  if (io::JournalFile* const source = file_ ? &*file_ : read_only ? &*read_only : nullptr) {
    while (std::optional<io::JournalEntry> entry = source->Next()) {
      take(std::move(*entry));
      ++stored_;
    }
    damaged = source->damaged();
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  return damaged;
}

void Journal::Append(io::JournalEntry entry, const std::function<void()>& settled) {
  bool has_to_wait = false;
  {
    const std::lock_guard lock(mutex_);
    has_to_wait = !trouble_.empty();
    waiting_.push_back({.entry = std::move(entry), .settled = has_to_wait ? nullptr : settled});
  }
  changed_.notify_all();
  if (has_to_wait && settled) settled();
}

void Journal::Work(const std::stop_token& stop) {
  const auto has_work = [this] { return !waiting_.empty(); };
  while (true) {
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, has_work)) return;  // Stopped, and nothing is left.
    }
    if (StoreOldest()) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, kRetryPeriod, [] { return false; });
    if (stop.stop_requested()) return;
    lock.unlock();
    try {
      Reopen();
    } catch (const io::JournalError& error) {
      Fail(error.what());
    }
  }
}

bool Journal::StoreOldest() {
  if (!file_) return false;
  const std::vector<io::JournalEntry> entries = OldestEntries();
  try {
    file_->Append(entries);
  } catch (const std::runtime_error& error) {
    Fail(error.what());
    return false;
  }
  std::vector<std::function<void()>> settled;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      settled.push_back(std::move(waiting_.front().settled));
      waiting_.pop_front();
    }
    trouble_.clear();
    stored_ += entries.size();
  }
  for (const std::function<void()>& tell : settled) {
    if (tell) tell();
  }
  changed_.notify_all();
  return true;
}

std::vector<io::JournalEntry> Journal::OldestEntries() const {
  const std::lock_guard lock(mutex_);
  std::vector<io::JournalEntry> entries;
  for (const Waiting& waiting : waiting_) {
    if (entries.size() == kBatch) break;
    entries.push_back(waiting.entry);
  }
  return entries;
}

// What waits for a disk is not kept from the other services as well.
void Journal::Fail(const std::string& trouble) {
  std::deque<std::function<void()>> settled;
  {
    const std::lock_guard lock(mutex_);
    trouble_ = trouble;
    for (Waiting& waiting : waiting_) settled.push_back(std::exchange(waiting.settled, nullptr));
  }
  for (const std::function<void()>& tell : settled) {
    if (tell) tell();
  }
  changed_.notify_all();
}

void Journal::WaitUntilSettled() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() || !trouble_.empty(); });
}

JournalStatus Journal::Status() const {
  const std::lock_guard lock(mutex_);
  return {.file = names_.file.string(),
          .trouble = trouble_,
          .stored = stored_,
          .waiting = waiting_.size()};
}

}  // namespace qwsm::team
