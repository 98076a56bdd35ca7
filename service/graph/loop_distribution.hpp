// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "slam6d/mapping/pose_graph.hpp"

namespace slam6d::graph {

/// Says how the error of a loop is spread over its scans.
enum class LoopDistribution {
  kLeastSquares,  ///< Spread by what is known of each pair (CeresLoopCloser).
  kAlongPath,     ///< Spread in proportion to the way (PathLoopCloser).
};

inline std::span<const std::pair<std::string_view, LoopDistribution>> Names(LoopDistribution) {
  static constexpr std::array<std::pair<std::string_view, LoopDistribution>, 2> kNames{{
      {"least-squares", LoopDistribution::kLeastSquares},
      {"along-path", LoopDistribution::kAlongPath},
  }};
  return kNames;
}

std::unique_ptr<LoopCloser> MakeLoopCloser(LoopDistribution distribution);

}  // namespace slam6d::graph
