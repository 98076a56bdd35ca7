// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/journal/journal.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "service/io/files/atomic_file.hpp"

namespace qwsm::team {
namespace {

// How often a disk that cannot be written is tried again.
constexpr std::chrono::milliseconds kRetryPeriod{500};
}  // namespace

Journal::Journal(Names names, Tell tell) : names_(std::move(names)), tell_(std::move(tell)) {
  try {
    Open();
  } catch (const io::WriteError& error) {
    Fail(error.what());
  }
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

Journal::Loss Journal::Restore(const std::function<void(io::JournalEntry)>& take) {
  Loss loss;
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
    loss = {.entries = source->damaged(), .damaged_copy = source->damaged_copy()};
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  return loss;
}

void Journal::Append(io::JournalEntry entry, std::function<void()> settled) {
  Take({.entry = std::move(entry), .settled = std::move(settled)});
}

void Journal::TellWhenSettled(std::function<void()> tell) {
  Take({.entry = std::nullopt, .settled = std::move(tell)});
}

void Journal::Take(Order order) {
  {
    const std::lock_guard lock(mutex_);
    if (order.entry) ++waiting_;
    orders_.push_back(std::move(order));
  }
  changed_.notify_all();
}

void Journal::Work(const std::stop_token& stop) {
  while (true) {
    std::vector<Order> orders = WaitForOrders(stop);
    for (Order& order : orders) {
      if (order.entry) unstored_.push_back(std::move(*order.entry));
    }
    if (stop.stop_requested() || Clock::now() >= next_try_) Store();
    for (const Order& order : orders) {
      if (order.settled) order.settled();
    }
    if (orders.empty() && stop.stop_requested()) return;
  }
}

/// Returns none where the thread is to stop, or to try a disk again.
std::vector<Journal::Order> Journal::WaitForOrders(const std::stop_token& stop) {
  const auto has_orders = [this] { return !orders_.empty(); };
  std::unique_lock lock(mutex_);
  is_settling_ = false;
  changed_.notify_all();
  if (unstored_.empty()) {
    changed_.wait(lock, stop, has_orders);
  } else {
    changed_.wait_until(lock, stop, next_try_, has_orders);
  }
  is_settling_ = true;
  return std::exchange(orders_, {});
}

void Journal::Store() {
  if (unstored_.empty()) return;
  try {
    if (!file_) Open();
    if (!file_->IsInPlace()) PutInPlace();
    file_->Append(unstored_);
  } catch (const std::runtime_error& error) {
    return Fail(error.what());
  }
  const std::size_t stored = unstored_.size();
  unstored_.clear();
  Conclude(stored, {});
}

void Journal::Open() {
  file_ = io::JournalFile::Continue(names_.file, names_.kind, names_.identity);
}

void Journal::PutInPlace() {
  file_->WriteAnew(names_.kind);
  tell_(true, names_.file.string() + ": was removed; it is written anew, with all that was in it");
}

// What has no name any more would be gone if it were closed.
void Journal::Fail(const std::string& trouble) {
  if (file_ && file_->IsInPlace()) file_.reset();
  next_try_ = Clock::now() + kRetryPeriod;
  Conclude(0, trouble);
}

// What waits and why changes at once: who sees that nothing waits sees no trouble. Each change is
// told once: what is wrong may be told in other words at each attempt.
void Journal::Conclude(std::size_t stored, const std::string& trouble) {
  bool had_trouble = false;
  {
    const std::lock_guard lock(mutex_);
    stored_ += stored;
    waiting_ -= stored;
    had_trouble = !trouble_.empty();
    trouble_ = trouble;
  }
  if (had_trouble == !trouble.empty()) return;
  if (had_trouble) return tell_(false, names_.file.string() + ": all scans are stored again");
  tell_(true, "scans cannot be stored, and wait until they can be: " + trouble);
}

void Journal::WaitUntilSettled() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return orders_.empty() && !is_settling_; });
}

JournalStatus Journal::Status() const {
  const std::lock_guard lock(mutex_);
  return {
      .file = names_.file.string(), .trouble = trouble_, .stored = stored_, .waiting = waiting_};
}

}  // namespace qwsm::team
