// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "submap_surfaces.hpp"

#include <algorithm>

namespace qwsm {
namespace {

constexpr std::size_t kMostKept = 16;

}  // namespace

const LikelihoodPyramid& SubmapSurfaces::likelihood() {
  if (!likelihood_) likelihood_ = surfaces_.MakeLikelihood();
  return *likelihood_;
}

double SubmapSurfaces::ShareSeenThrough(std::span<const ScanPoint> points,
                                        const Pose2& T_chain_robot) const {
  const std::vector<std::uint8_t> marks = seen_free_.MovingAmong(points, T_chain_robot);
  if (marks.empty()) return 0.0;
  return static_cast<double>(std::ranges::count(marks, 1)) / static_cast<double>(marks.size());
}

SubmapSurfaces& RecentSurfaces::Of(const Key& submap, const std::function<SubmapSurfaces()>& make) {
  const auto known = std::ranges::find(kept_, submap, &std::pair<Key, SubmapSurfaces>::first);
  if (known != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, known);
  } else {
    if (kept_.size() == kMostKept) kept_.pop_back();
    kept_.emplace_front(submap, make());
  }
  return kept_.front().second;
}

}  // namespace qwsm
