// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/result_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace qwsm::pipeline {
namespace {

struct NamedFile {
  ResultFile file;
  std::string_view name;
};

// In the order of ResultFile.
constexpr auto kResultFiles = std::to_array<NamedFile>({
    {ResultFile::kAnswers, "answers.mcap"},
    {ResultFile::kComparison, "comparison.csv"},
    {ResultFile::kConfig, "config.yaml"},
    {ResultFile::kEpochs, "epochs.csv"},
    {ResultFile::kFigure3QWsm, "figure-3-q-wsm.png"},
    {ResultFile::kFigure3Wsm, "figure-3-wsm.png"},
    {ResultFile::kFigure4, "figure-4.png"},
    {ResultFile::kGraphG2o, "graph.g2o"},
    {ResultFile::kGraphToro, "graph.toro"},
    {ResultFile::kIterations, "iterations.png"},
    {ResultFile::kLoops, "loops.csv"},
    {ResultFile::kMapImage, "map.pgm"},
    {ResultFile::kMapPicture, "map.png"},
    {ResultFile::kMap, "map.yaml"},
    {ResultFile::kLiveMapPicture, "map_live.png"},
    {ResultFile::kMarks, "marks.csv"},
    {ResultFile::kMetrics, "metrics.json"},
    {ResultFile::kModel, "model.ply"},
    {ResultFile::kReport, "report.html"},
    {ResultFile::kResiduals, "residual.png"},
    {ResultFile::kLog, "run.log"},
    {ResultFile::kScans, "scans.csv"},
    {ResultFile::kScenario, "scenario.yaml"},
    {ResultFile::kSideAfter, "side_after.png"},
    {ResultFile::kSideBefore, "side_before.png"},
    {ResultFile::kSpeedUp, "speed_up.png"},
    {ResultFile::kTable, "table.csv"},
    {ResultFile::kTableMarkdown, "table.md"},
    {ResultFile::kTopAfter, "top_after.png"},
    {ResultFile::kTopBefore, "top_before.png"},
    {ResultFile::kTrajectoryKitti, "trajectory.kitti"},
    {ResultFile::kTrajectoryPicture, "trajectory.png"},
    {ResultFile::kTrajectory, "trajectory.tum"},
    {ResultFile::kLiveTrajectory, "trajectory_live.tum"},
    {ResultFile::kTruth, "truth.tum"},
});

constexpr std::size_t IndexOf(ResultFile file) { return static_cast<std::size_t>(file); }

consteval bool AreInOrder() {
  for (std::size_t i = 0; i < kResultFiles.size(); ++i) {
    if (IndexOf(kResultFiles[i].file) != i) return false;
  }
  return kResultFiles.size() == IndexOf(ResultFile::kTruth) + 1;
}
static_assert(AreInOrder());

}  // namespace

std::string_view NameOf(ResultFile file) { return kResultFiles[IndexOf(file)].name; }

bool IsResultFile(std::string_view name) {
  return std::ranges::find(kResultFiles, name, &NamedFile::name) != kResultFiles.end();
}

}  // namespace qwsm::pipeline
