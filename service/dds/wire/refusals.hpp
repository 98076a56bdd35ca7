// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace qwsm::dds {

/// Counts samples that could not be used, by kind. The first of a kind is told at once.
class Refusals {
 public:
  struct Kind {
    std::string topic;
    std::string why;
    std::uint64_t count = 0;
  };

  /// Starts with no refusal.
  /// @param on_first told once per kind, such as `/scan: a sample was refused: its stamp is no
  /// time`.
  explicit Refusals(std::function<void(const std::string&)> on_first)
      : on_first_(std::move(on_first)) {}

  void Add(const std::string& topic, std::string_view why);
  /// Tells of what is used all the same, though not as it should be.
  void Tell(const std::string& what) const { on_first_(what); }
  /// All kinds with their counts. Safe to ask from another thread.
  std::vector<Kind> All() const;

 private:
  std::function<void(const std::string&)> on_first_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, std::uint64_t> counts_;
};

}  // namespace qwsm::dds
