// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/worker_pool.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>
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
    Run(*next.entry, lock);
    changed_.notify_all();
  }
}

void WorkerPool::Run(Entry& entry, std::unique_lock<std::mutex>& lock) {
  fair_share_ = std::max(fair_share_, entry.used);
  entry.is_running = true;
  lock.unlock();
  const Lane::Time begun = Lane::Time::clock::now();
  entry.lane->RunOne();
  const Duration used = Lane::Time::clock::now() - begun;
  lock.lock();
  entry.is_running = false;
  entry.used += used;
}

/// Of those that can be run now, the one that has used least; where there is none, the one that can
/// be run first.
WorkerPool::Choice WorkerPool::NextOf() {
  const Lane::Time now = Lane::Time::clock::now();
  Choice next;
  for (const std::unique_ptr<Entry>& entry : entries_) {
    if (entry->is_running) continue;
    const std::optional<Lane::Time> ready_at = entry->lane->ReadyAt();
    Note(*entry, ready_at.has_value());
    if (!ready_at) continue;
    const auto rank = [now](const Entry& of, Lane::Time at) {
      return std::tuple(std::max(at, now), of.used, at);
    };
    if (next.entry != nullptr && rank(*next.entry, next.ready_at) <= rank(*entry, *ready_at)) {
      continue;
    }
    next = {.entry = entry.get(), .ready_at = *ready_at};
  }
  return next;
}

void WorkerPool::Note(Entry& entry, bool has_work) const {
  if (has_work && !entry.has_work) entry.used = std::max(entry.used, fair_share_);
  entry.has_work = has_work;
}

bool WorkerPool::IsIdle() const {
  return std::ranges::none_of(entries_, [](const std::unique_ptr<Entry>& entry) {
    return entry->is_running || entry->lane->ReadyAt().has_value();
  });
}

}  // namespace qwsm::team
