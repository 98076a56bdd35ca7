// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/graph/loop_distribution.hpp"

#include "slam6d/graph/ceres_loop_closer.hpp"

namespace slam6d::graph {

std::unique_ptr<LoopCloser> MakeLoopCloser(LoopDistribution distribution) {
  if (distribution == LoopDistribution::kAlongPath) return std::make_unique<PathLoopCloser>();
  return std::make_unique<CeresLoopCloser>();
}

}  // namespace slam6d::graph
