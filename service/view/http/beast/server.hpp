// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <utility>

#include "service/view/http/web_handler.hpp"

namespace qwsm::view {

inline constexpr std::chrono::seconds kTimeToAsk{5};  // Or to agree on keys.
inline constexpr std::chrono::seconds kTimeToTake{20};
inline constexpr std::chrono::seconds kSilence{20};  // Of a socket; half of it, and it is pinged.

inline constexpr std::uint32_t kLongestHeader = 8 * 1024;

/// What all connections share. Used by the server's thread, but for the counts.
struct Server {
  WebHandler& handler;
  std::size_t max_sockets;
  std::atomic<std::size_t> sockets = 0;
  std::atomic<std::size_t> connections = 0;
  std::atomic<std::size_t> refused = 0;
  std::list<std::function<void()>> kicks{};  ///< One of each socket: look for something to send.
};

/// Counts something as long as it is there, through whatever hands it goes.
class Counted {
 public:
  explicit Counted(std::atomic<std::size_t>& count) : count_(&count) { ++count; }
  Counted(Counted&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
  Counted& operator=(Counted&&) = delete;
  ~Counted() {
    if (count_ != nullptr) --*count_;
  }

 private:
  std::atomic<std::size_t>* count_;
};

}  // namespace qwsm::view
