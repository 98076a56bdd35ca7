// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "service/dds/entities/entity.hpp"
#include "service/dds/entities/participant.hpp"

namespace qwsm::dds {

/// Sleeps until one of several readers has samples, or somebody calls.
class WaitSet {
 public:
  explicit WaitSet(const Participant& participant);

  /// Lets the wait set wait for a reader too.
  /// @param reader outlives the wait set, or is removed before.
  void Add(Entity::Handle reader);
  void Remove(Entity::Handle reader);

  /// Waits for samples or a call. To be called by one thread. @returns the readers that have
  /// samples; none where the time passed first.
  std::vector<Entity::Handle> Wait(std::chrono::nanoseconds timeout);
  /// Ends a wait in another thread, or the next wait.
  void Wake();

 private:
  Entity wait_set_;
  Entity bell_;
  std::vector<std::intptr_t> woken_;  // Room for all that can wake it.
};

}  // namespace qwsm::dds
