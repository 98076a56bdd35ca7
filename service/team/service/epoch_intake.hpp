// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <stop_token>
#include <thread>

#include "service/team/scans/team_epoch.hpp"

namespace qwsm::team {

/// Takes in corrections of other services, one after the other, in a thread of its own: who brings
/// them brings robots' messages, too, and must not wait until maps are made anew. All functions may
/// be called from any thread.
class EpochIntake {
 public:
  using TakeIn = std::function<void(const TeamEpoch&)>;

  explicit EpochIntake(TakeIn take_in);
  /// Stops as Stop() does.
  ~EpochIntake() { Stop(); }
  EpochIntake(const EpochIntake&) = delete;
  EpochIntake& operator=(const EpochIntake&) = delete;

  /// Puts a correction behind those that wait. Of one service only the newest waits: it names all
  /// scans of those before.
  void Put(TeamEpoch epoch);
  /// Finishes the one at work; those that wait are left out.
  void Stop();
  /// Waits until all are taken in, or it has stopped.
  void WaitUntilIdle();

 private:
  void Work(const std::stop_token& stop);

  const TakeIn take_in_;
  std::mutex mutex_;  // Guards what follows.
  std::condition_variable_any changed_;
  std::list<TeamEpoch> waiting_;
  bool is_working_ = true;  // False while the thread waits, or has ended.
  std::jthread thread_;     // Last: it uses all members above.
};

}  // namespace qwsm::team
