// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Uses the installed loop closer: two scans, and two opinions of the second one's place that weigh
// the same.
#include <cmath>
#include <cstdlib>

#include "slam6d/graph/ceres_loop_closer.hpp"

int main() {
  slam6d::PoseGraph graph{.T_map_scan = {slam6d::Pose3{}, slam6d::Pose3{}}, .constraints = {}};
  for (const double x_m : {1.0, 1.2}) {
    graph.constraints.push_back(
        {.from = 0, .to = 1, .T_from_to = {.translation_m = {x_m, 0.0, 0.0}}});
  }
  const auto T_map_scan = slam6d::graph::CeresLoopCloser().Close(graph);
  return std::abs(T_map_scan[1].translation_m.x() - 1.1) < 1e-6 ? EXIT_SUCCESS : EXIT_FAILURE;
}
