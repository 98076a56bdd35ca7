// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace qwsm::team {

/// Work that is done piece by piece in order, such as one robot's scans.
class Lane {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Lane() = default;
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;
  virtual ~Lane() = default;

  /// When the next piece can be done; nothing where there is none. Any thread may ask.
  virtual std::optional<Time> ReadyAt() const = 0;
  /// Does the next piece, if there is still one. Called by one thread at a time. Must not throw.
  virtual void RunOne() = 0;
};

/// Threads that work on lanes: each lane in order, the lanes side by side. Where more than one has
/// work, it is the turn of that which has had least of the workers' time: a lane whose pieces take
/// long is worked on less often, and costs the others nothing but the piece that is at work (start
/// time fair queueing, Goyal et al. 1996).
class WorkerPool {
 public:
  /// Starts the threads. @pre threads > 0
  explicit WorkerPool(int threads);
  /// Stops as Stop() does.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Adds a lane, which is kept until the pool goes.
  void Add(std::shared_ptr<Lane> lane);
  /// Says that there may be something new to do.
  void Wake();
  /// Waits until no lane has anything to do, now or later.
  void WaitUntilIdle();
  /// Lets the pieces at work be finished, and begins no more.
  void Stop();

 private:
  using Duration = Lane::Time::duration;
  struct Entry {
    std::shared_ptr<Lane> lane;
    bool is_running = false;
    bool has_work = false;  // Whether the lane had work when it was looked at last.
    // Workers' time the lane has had; what it left unused while idle counts, too.
    Duration used{};
  };
  struct Choice {
    Entry* entry = nullptr;  // The lane to run, once it is time.
    Lane::Time ready_at{};
  };

  void Work(const std::stop_token& stop);
  void Run(Entry& entry, std::unique_lock<std::mutex>& lock);
  Choice NextOf();
  void Note(Entry& entry, bool has_work) const;
  bool IsIdle() const;

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<std::unique_ptr<Entry>> entries_;
  Duration fair_share_{};  // What the entry that ran last had used: who is back begins with that.
  std::vector<std::jthread> threads_;  // Last: they use all members above.
};

}  // namespace qwsm::team
