// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/thinning.hpp"

#include <cstdint>

namespace qwsm::team {
namespace {

std::size_t StepFor(std::size_t size, std::size_t most) {
  return size > most ? (size + most - 1) / most : 1;
}

}  // namespace

std::size_t Thin(LaserScan& scan, std::size_t most) {
  const std::size_t step = StepFor(scan.size(), most);
  if (step == 1) return step;
  const auto gaps = static_cast<std::int64_t>(scan.size() - 1);
  std::size_t kept = 0;
  for (std::size_t beam = 0; beam < scan.size(); beam += step) {
    scan.ranges_m[kept++] = scan.ranges_m[beam];
  }
  scan.ranges_m.resize(kept);
  scan.ranges_m.shrink_to_fit();
  scan.geometry.bearing_step_rad *= static_cast<float>(step);
  scan.sweep = scan.sweep * static_cast<std::int64_t>((kept - 1) * step) / gaps;
  return step;
}

std::size_t Thin(CloudScan& scan, std::size_t most) {
  const std::size_t step = StepFor(scan.cloud.size(), most);
  if (step == 1) return step;
  slam6d::PointCloud kept;
  kept.reserve(scan.cloud.size() / step + 1);
  for (std::size_t i = 0; i < scan.cloud.size(); i += step) kept.push_back(scan.cloud[i]);
  scan.cloud = std::move(kept);
  return step;
}

}  // namespace qwsm::team
