// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace slam6d {

/// Every so many-th of the points, at most `most` of them. @pre most > 0
template <class Points>
Points Sample(const Points& points, std::size_t most) {
  const std::size_t step = (points.size() + most - 1) / most;
  Points sample;
  for (std::size_t i = 0; i < points.size(); i += step) sample.push_back(points[i]);
  return sample;
}

}  // namespace slam6d
