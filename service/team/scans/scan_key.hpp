// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace qwsm::team {

/// Tells one relevant scan from all others, wherever it was heard of.
struct ScanKey {
  std::string service;  ///< Service that matched the scan; see TeamService::identity().
  std::string robot;    ///< Robot that took the scan, by its namespace.
  /// Number that grows with the service's relevant scans of that robot.
  std::uint64_t sequence = 0;

  friend auto operator<=>(const ScanKey&, const ScanKey&) = default;
};

/// Sequence numbers of a run begin with its time in microseconds, as no robot makes that many
/// scans: a service that was killed while it could not write its journal does not know which
/// numbers it gave.
inline std::uint64_t SequenceOfNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(now / std::chrono::microseconds(1));
}

struct ScanKeyHash {
  std::size_t operator()(const ScanKey& key) const {
    constexpr std::size_t kFactor = 1'000'003;
    const std::hash<std::string> text;
    return (text(key.service) * kFactor + text(key.robot)) * kFactor +
           static_cast<std::size_t>(key.sequence);
  }
};

}  // namespace qwsm::team
