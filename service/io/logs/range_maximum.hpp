// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm::io {

/// Finds what a laser writes for "no echo" where its log does not state a maximum range.
///
/// Scanners write "no echo" as one value, or a few next to each other, near the end of their range
/// (81.91, 81.83, 51.15, 50.0, 8.183 m ...). Seen from different places real surfaces spread over
/// all distances, so that value stands out as a spike above which there is next to nothing. Every
/// place counts once: a robot that stands still before a far wall would make a spike of the wall.
class RangeMaximumEstimator {
 public:
  RangeMaximumEstimator();

  /// Takes in a sweep of a log, in order.
  void Add(std::span<const float> ranges_m, const std::optional<Pose2>& T_odom_robot);

  /// The value for "no echo", in metres, as far as the sweeps so far tell; where there is none, a
  /// maximum well beyond what was read.
  float Estimate() const;

 private:
  bool IsNewPlace(const std::optional<Pose2>& T_odom_robot);
  bool IsSpike(std::size_t top, std::uint64_t above) const;

  std::vector<std::uint32_t> counts_;    // Number of readings, by range.
  std::vector<float> largest_m_;         // Largest reading in each bin.
  std::optional<Pose2> T_odom_sampled_;  // Odometry where the last counted sweep was taken.
  std::size_t sweeps_at_place_ = 0;
  std::size_t places_ = 0;
};

}  // namespace qwsm::io
