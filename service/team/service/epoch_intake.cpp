// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/epoch_intake.hpp"

#include <utility>

namespace qwsm::team {

EpochIntake::EpochIntake(TakeIn take_in)
    : take_in_(std::move(take_in)), thread_([this](const std::stop_token& stop) { Work(stop); }) {}

void EpochIntake::Put(TeamEpoch epoch) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.remove_if([&](const TeamEpoch& one) {
      return one.rank.service == epoch.rank.service && one.rank <= epoch.rank;
    });
    waiting_.push_back(std::move(epoch));
  }
  changed_.notify_all();
}

void EpochIntake::Stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void EpochIntake::WaitUntilIdle() {
  std::unique_lock lock(mutex_);
  changed_.wait(
      lock, thread_.get_stop_token(), [this] { return waiting_.empty() && !is_working_; });
}

void EpochIntake::Work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (true) {
    is_working_ = false;
    changed_.notify_all();
    changed_.wait(lock, stop, [this] { return !waiting_.empty(); });
    if (stop.stop_requested()) return;
    is_working_ = true;
    const TeamEpoch epoch = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    take_in_(epoch);
    lock.lock();
  }
}

}  // namespace qwsm::team
