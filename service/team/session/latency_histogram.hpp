// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace qwsm::team {

/// Counts how long things took, from a microsecond to minutes, in 4 kB however many they were.
class LatencyHistogram {
 public:
  void Add(std::chrono::nanoseconds duration);

  std::uint64_t count() const { return count_; }
  std::chrono::nanoseconds longest() const { return longest_; }
  /// The duration that `share` (0..1) of the counted ones did not exceed, at most 5 % too long; 0
  /// if there are none.
  std::chrono::nanoseconds Quantile(double share) const;

 private:
  static constexpr int kBucketsPerOctave = 16;
  // Buckets for durations up to 2^28 us.
  static constexpr std::size_t kBuckets = 28 * kBucketsPerOctave;

  std::array<std::uint64_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::chrono::nanoseconds longest_{};
};

}  // namespace qwsm::team
