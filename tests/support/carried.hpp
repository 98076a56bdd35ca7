// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "qwsm/mapping/observation.hpp"

namespace qwsm::test {

/// A part of a log that is left out.
struct LogGap {
  std::size_t first = 0;
  std::size_t scans = 0;
};

/// A gap of 3, 6, 12 or 25 % of a log, anywhere but near its ends.
inline LogGap RandomGap(std::size_t scans, unsigned seed) {
  constexpr std::size_t kPercent[] = {3, 6, 12, 25};
  std::mt19937 random(seed);
  LogGap gap{.first = 0, .scans = scans * kPercent[random() % 4] / 100};
  const std::size_t margin = scans / 10;
  gap.first = margin + random() % (scans - 2 * margin - gap.scans);
  return gap;
}

/// The log of a robot that was carried meanwhile: neither scans nor odometry know of the way.
inline std::vector<Observation> Carried(std::vector<Observation> observations, const LogGap& gap) {
  const auto first = observations.begin() + static_cast<std::ptrdiff_t>(gap.first);
  const auto after = first + static_cast<std::ptrdiff_t>(gap.scans);
  const Pose2 T_new_odom = *(first - 1)->T_odom_robot * after->T_odom_robot->Inverse();
  std::for_each(after, observations.end(), [&](Observation& observation) {
    observation.T_odom_robot = T_new_odom * *observation.T_odom_robot;
  });
  observations.erase(first, after);
  return observations;
}

}  // namespace qwsm::test
