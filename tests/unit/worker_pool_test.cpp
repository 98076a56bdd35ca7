// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/worker_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

/// The letters of the lanes, in the order in which their pieces were done.
class Record {
 public:
  void Add(char letter) {
    const std::lock_guard lock(mutex_);
    letters_ += letter;
  }
  std::string letters() const {
    const std::lock_guard lock(mutex_);
    return letters_;
  }

 private:
  mutable std::mutex mutex_;
  std::string letters_;
};

/// Pieces that all came at one moment, and take so long each.
class Pieces final : public Lane {
 public:
  Pieces(char letter, int count, std::chrono::milliseconds each, Time arrived, Record& record)
      : letter_(letter), left_(count), each_(each), arrived_(arrived), record_(record) {}

  std::optional<Time> ReadyAt() const override {
    return left_ > 0 ? std::optional(arrived_) : std::nullopt;
  }
  void RunOne() override {
    const Time end = Time::clock::now() + each_;
    while (Time::clock::now() < end) std::this_thread::yield();
    record_.Add(letter_);
    --left_;
  }

 private:
  const char letter_;
  std::atomic<int> left_;
  const std::chrono::milliseconds each_;
  const Time arrived_;
  Record& record_;
};

TEST(WorkerPool, HeavyWorkThatCameFirstDoesNotKeepLightWorkWaiting) {
  Record record;
  WorkerPool pool(1);
  const Lane::Time now = Lane::Time::clock::now();
  pool.Add(std::make_shared<Pieces>('H', 20, 20ms, now - 2s, record));
  pool.Add(std::make_shared<Pieces>('L', 10, 0ms, now - 1s, record));
  pool.WaitUntilIdle();
  // One heavy piece may have begun before the light lane came, and lasts as long as ten light ones.
  EXPECT_LE(record.letters().rfind('L'), 12U) << record.letters();
  EXPECT_EQ(record.letters().size(), 30U);
}

TEST(WorkerPool, LanesThatAreEquallyHeavyTakeTurns) {
  Record record;
  {
    WorkerPool pool(1);
    const Lane::Time now = Lane::Time::clock::now();
    pool.Add(std::make_shared<Pieces>('A', 10, 5ms, now - 2s, record));
    pool.Add(std::make_shared<Pieces>('B', 10, 5ms, now - 1s, record));
    pool.WaitUntilIdle();
  }
  EXPECT_LT(record.letters().find('B'), 4U) << record.letters();
  EXPECT_GT(record.letters().rfind('A'), 14U) << record.letters();
}

TEST(WorkerPool, WhoHadNothingToDoHasNotSavedUpForIt) {
  Record record;
  WorkerPool pool(1);
  const Lane::Time now = Lane::Time::clock::now();
  pool.Add(std::make_shared<Pieces>('A', 20, 5ms, now, record));
  // Its pieces come when the other lane has long had its time.
  pool.Add(std::make_shared<Pieces>('B', 20, 5ms, now + 50ms, record));
  pool.WaitUntilIdle();
  const std::string since = record.letters().substr(record.letters().find('B'), 15);
  EXPECT_NE(since.find('A'), std::string::npos) << record.letters();
}

}  // namespace
}  // namespace qwsm::team
