// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>

namespace qwsm::team {

/// A large state that is read for long and changed in small steps, at the same time, by many.
///
/// Two copies are kept. Readers read the one that is open; a change is made to the hidden one, the
/// two are exchanged, and the other one is brought up to date when the next change begins. So no
/// reader ever waits for a change; a change waits only for readers that began before the change
/// before it. Costs twice the memory and makes every change twice ("left-right", Ramalhete and
/// Correia 2013, with locks where they have counters).
///
/// Whoever has changed the state reads a state with that change from then on.
///
/// @tparam State copyable. @tparam Change depends on nothing but the state it is applied to.
template <class State, class Change>
class TwinState {
 public:
  using Apply = void (*)(State&, const Change&);

  TwinState(const State& state, Apply apply) : apply_(apply), twins_{Twin(state), Twin(state)} {}

  /// The state as it is now, which stays as it is as long as the view lives. Keep it for no longer
  /// than needed: the second change from now waits for it.
  class View {
   public:
    const State& operator*() const { return *state_; }
    const State* operator->() const { return state_; }

   private:
    friend class TwinState;
    View(std::shared_lock<std::shared_mutex> lock, const State& state)
        : lock_(std::move(lock)), state_(&state) {}

    std::shared_lock<std::shared_mutex> lock_;
    const State* state_;
  };

  View Read() const {
    for (;;) {
      const Twin& open = twins_[open_.load()];
      std::shared_lock lock(*open.mutex, std::try_to_lock);
      // Otherwise it was exchanged, and is already being changed, since its number was read.
      if (lock) return View(std::move(lock), open.state);
    }
  }

  /// Makes a change and returns it. @param decide returns the change, given the newest state.
  template <class Decide>
  std::shared_ptr<const Change> Write(Decide decide) {
    const std::lock_guard writer(writer_);
    const std::size_t hidden = 1 - open_.load();
    Twin& twin = twins_[hidden];
    {
      const std::lock_guard lock(*twin.mutex);
      if (latest_) apply_(twin.state, *latest_);
      latest_ = std::make_shared<const Change>(decide(std::as_const(twin.state)));
      apply_(twin.state, *latest_);
    }
    open_.store(hidden);
    return latest_;
  }

 private:
  struct Twin {
    explicit Twin(const State& initial) : state(initial) {}
    State state;
    std::unique_ptr<std::shared_mutex> mutex = std::make_unique<std::shared_mutex>();
  };

  Apply apply_;
  std::array<Twin, 2> twins_;
  std::atomic<std::size_t> open_ = 0;
  std::mutex writer_;
  // The change not yet made to the twin that is hidden now.
  std::shared_ptr<const Change> latest_;
};

}  // namespace qwsm::team
