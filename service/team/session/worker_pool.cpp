// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/worker_pool.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace qwsm::team {

WorkerPool::WorkerPool(int threads) {
  assert(threads > 0);
  for (int i = 0; i < threads; ++i) {
    threads_.emplace_back([this](const std::stop_token& stop) { Work(stop); });
  }
}

WorkerPool::~WorkerPool() { Stop(); }

void WorkerPool::Add(std::shared_ptr<Lane> lane) {
  {
    const std::lock_guard lock(mutex_);
    entries_.push_back(std::make_unique<Entry>(Entry{.lane = std::move(lane)}));
  }
  changed_.notify_all();
}

void WorkerPool::Wake() {
  // Whoever has just found nothing to do is waiting once the mutex is free.
  { const std::lock_guard lock(mutex_); }
  changed_.notify_all();
}

void WorkerPool::WaitUntilIdle() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return IsIdle(); });
}

void WorkerPool::Stop() {
  {
    // Locked: no thread is between looking whether to stop and waiting.
    const std::lock_guard lock(mutex_);
    for (std::jthread& thread : threads_) thread.request_stop();
  }
  changed_.notify_all();
  threads_.clear();
}

void WorkerPool::Work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const Choice next = NextOf();
    if (next.entry == nullptr) {
      changed_.wait(lock, stop, [this] { return NextOf().entry != nullptr; });
      continue;
    }
    if (next.ready_at > Lane::Time::clock::now()) {
      changed_.wait_until(lock, next.ready_at);
      continue;
    }
    next.entry->is_running = true;
    lock.unlock();
    next.entry->lane->RunOne();
    lock.lock();
    next.entry->is_running = false;
    changed_.notify_all();
  }
}

WorkerPool::Choice WorkerPool::NextOf() const {
  Choice first;
  for (const std::unique_ptr<Entry>& entry : entries_) {
    if (entry->is_running) continue;
    const std::optional<Lane::Time> ready_at = entry->lane->ReadyAt();
    if (!ready_at || (first.entry != nullptr && first.ready_at <= *ready_at)) continue;
    first = {.entry = entry.get(), .ready_at = *ready_at};
  }
  return first;
}

bool WorkerPool::IsIdle() const {
  return std::ranges::none_of(entries_, [](const std::unique_ptr<Entry>& entry) {
    return entry->is_running || entry->lane->ReadyAt().has_value();
  });
}

}  // namespace qwsm::team
