// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/result_file.hpp"

#include <algorithm>
#include <array>

namespace qwsm::pipeline {
namespace {

// By ResultFile.
constexpr auto kResultNames = std::to_array<std::string_view>({
    "answers.mcap",
    "comparison.csv",
    "config.yaml",
    "epochs.csv",
    "figure-3-q-wsm.png",
    "figure-3-wsm.png",
    "figure-4.png",
    "graph.g2o",
    "graph.toro",
    "iterations.png",
    "loops.csv",
    "map.pgm",
    "map.png",
    "map.yaml",
    "map_live.png",
    "marks.csv",
    "metrics.json",
    "model.ply",
    "report.html",
    "residual.png",
    "run.log",
    "scans.csv",
    "scenario.yaml",
    "side_after.png",
    "side_before.png",
    "speed_up.png",
    "table.csv",
    "table.md",
    "top_after.png",
    "top_before.png",
    "trajectory.kitti",
    "trajectory.png",
    "trajectory.tum",
    "trajectory_live.tum",
    "truth.tum",
});
static_assert(kResultNames.size() == static_cast<std::size_t>(ResultFile::kTruth) + 1);

}  // namespace

std::string_view NameOf(ResultFile file) { return kResultNames[static_cast<std::size_t>(file)]; }

bool IsResultFile(std::string_view name) {
  return std::ranges::find(kResultNames, name) != kResultNames.end();
}

}  // namespace qwsm::pipeline
