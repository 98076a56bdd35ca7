// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/range_maximum.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

constexpr float kShortest_m = 1.0F;
constexpr float kLongest_m = 1024.0F;

/// Bins of 0.05 - 0.1 % of the range: the leading bits of a float are nearly its logarithm.
constexpr std::uint32_t BinOf(float range_m) {
  constexpr std::uint32_t kDroppedBits = 13;
  return (std::bit_cast<std::uint32_t>(range_m) - std::bit_cast<std::uint32_t>(kShortest_m)) >>
         kDroppedBits;
}

constexpr std::size_t kBins = BinOf(kLongest_m);

// The codes of one scanner lie within 0.2 % of each other (8183 - 8191 mm; 51.10 - 51.16 m).
constexpr std::size_t kSpikeBins = 6;
// What lies below is compared over some 10 % of the range.
constexpr std::size_t kBelowBins = 128;
constexpr std::uint64_t kMinSpikeCount = 20;
constexpr std::size_t kMinPlaces = 10;
constexpr double kPlaceSpacing_m = 0.1;
constexpr std::size_t kSweepsWithoutOdometry = 10;
constexpr std::size_t kSweepsOfARobotAtRest = 500;

/// What a SICK LMS writes for "no echo" in its longest setting.
constexpr float kLongestCommon_m = 81.91F;
constexpr float kMarginOverReadings = 1.1F;

}  // namespace

RangeMaximumEstimator::RangeMaximumEstimator() : counts_(kBins), largest_m_(kBins) {}

void RangeMaximumEstimator::Add(std::span<const float> ranges_m,
                                const std::optional<Pose2>& T_odom_robot) {
  if (!IsNewPlace(T_odom_robot)) return;
  ++places_;
  for (const float range_m : ranges_m) {
    if (!(range_m >= kShortest_m && range_m < kLongest_m)) continue;
    const std::uint32_t bin = BinOf(range_m);
    ++counts_[bin];
    largest_m_[bin] = std::max(largest_m_[bin], range_m);
  }
}

/// A place is where the robot has moved to. Where odometry does not tell, or never moves, some of
/// the sweeps have to do.
bool RangeMaximumEstimator::IsNewPlace(const std::optional<Pose2>& T_odom_robot) {
  ++sweeps_at_place_;
  const bool moved =
      T_odom_robot && (!T_odom_sampled_ ||
                       (T_odom_robot->translation_m() - T_odom_sampled_->translation_m()).norm() >=
                           kPlaceSpacing_m);
  const std::size_t enough = T_odom_robot ? kSweepsOfARobotAtRest : kSweepsWithoutOdometry;
  if (!moved && sweeps_at_place_ < enough && places_ > 0) return false;
  if (T_odom_robot) T_odom_sampled_ = T_odom_robot;
  sweeps_at_place_ = 0;
  return true;
}

float RangeMaximumEstimator::Estimate() const {
  const std::uint64_t total = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  const std::uint64_t garbage = total / 10'000;  // As much may lie far beyond the scanner's reach.
  std::uint64_t above = 0;
  float longest_m = 0.0F;
  for (std::size_t top = kBins; top-- > kBelowBins;) {
    if (counts_[top] == 0) continue;
    if (IsSpike(top, above)) return largest_m_[top];
    above += counts_[top];
    if (longest_m == 0.0F && above > garbage) longest_m = largest_m_[top];
  }
  return std::clamp(kMarginOverReadings * longest_m, kLongestCommon_m, kLongestRange_m);
}

/// Whether the readings in the bins up to `top` stand out from those below, with next to nothing
/// above.
bool RangeMaximumEstimator::IsSpike(std::size_t top, std::uint64_t above) const {
  const auto end = counts_.begin() + static_cast<std::ptrdiff_t>(top) + 1;
  const auto begin = end - kSpikeBins;
  const std::uint64_t spike = std::accumulate(begin, end, std::uint64_t{0});
  if (places_ < kMinPlaces || spike < kMinSpikeCount || 50 * above > spike) return false;
  // Evenly spread readings would make it a twentieth of those below.
  const std::uint64_t below = std::accumulate(end - kBelowBins, begin, std::uint64_t{0});
  return 2 * spike >= below;
}

}  // namespace qwsm::io
