// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm::team {

void LatencyHistogram::Add(std::chrono::nanoseconds duration) {
  const double microseconds =
      std::max(1.0, std::chrono::duration<double, std::micro>(duration).count());
  const auto bucket = static_cast<std::size_t>(kBucketsPerOctave * std::log2(microseconds));
  ++buckets_[std::min(bucket, kBuckets - 1)];
  ++count_;
  longest_ = std::max(longest_, duration);
}

std::chrono::nanoseconds LatencyHistogram::Quantile(double share) const {
  const double wanted = share * static_cast<double>(count_);
  std::uint64_t seen = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    seen += buckets_[bucket];
    if (buckets_[bucket] == 0 || static_cast<double>(seen) < wanted) continue;
    const double upper_us = std::exp2(static_cast<double>(bucket + 1) / kBucketsPerOctave);
    const std::chrono::duration<double, std::micro> upper(upper_us);
    return std::min(longest_, std::chrono::duration_cast<std::chrono::nanoseconds>(upper));
  }
  return {};
}

}  // namespace qwsm::team
