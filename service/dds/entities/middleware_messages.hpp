// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

namespace qwsm::dds {

/// While an object of this class lives, what the middleware has to say goes to a function instead
/// of to stderr, and at most so often: a hostile peer can make it complain 10 000 times a second.
class MiddlewareMessages {
 public:
  using Sink = std::function<void(const std::string& text)>;

  /// Takes over what the middleware says. @param sink is called from any thread, by one at a time.
  explicit MiddlewareMessages(Sink sink, int per_second = 5);
  MiddlewareMessages(const MiddlewareMessages&) = delete;
  MiddlewareMessages& operator=(const MiddlewareMessages&) = delete;
  ~MiddlewareMessages();

  void Take(const std::string& text);

 private:
  Sink sink_;
  int per_second_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point second_;  // Begin of the second that is counted.
  int said_ = 0;
  std::size_t withheld_ = 0;
};

}  // namespace qwsm::dds
