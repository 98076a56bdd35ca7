// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slam6d {

/// The values between which all but strays lie.
struct Bounds {
  double low = 0.0;
  double high = 0.0;
};

/// Bounds of nearly all values; both are 0 where there are none. O(n)
/// @param stray_share of the values at either end, below 0.5.
inline Bounds BoundsOf(std::vector<double> values, double stray_share) {
  if (values.empty()) return {};
  const auto strays = static_cast<std::ptrdiff_t>(stray_share * static_cast<double>(values.size()));
  const auto low = values.begin() + strays;
  std::ranges::nth_element(values, low);
  const double low_value = *low;
  const auto high = values.end() - 1 - strays;
  std::ranges::nth_element(values, high);
  return {.low = low_value, .high = *high};
}

}  // namespace slam6d
