// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace qwsm::pipeline {

/// What programs leave in a folder of results, but for maps that --save-map was asked for, scans in
/// 3D and logs of simulated robots.
enum class ResultFile {
  kAnswers,
  kComparison,
  kConfig,
  kEpochs,
  kFigure3QWsm,
  kFigure3Wsm,
  kFigure4,
  kGraphG2o,
  kGraphToro,
  kIterations,
  kLoops,
  kMapImage,
  kMapPicture,
  kMap,
  kLiveMapPicture,
  kMarks,
  kMetrics,
  kModel,
  kReport,
  kResiduals,
  kLog,
  kScans,
  kScenario,
  kSideAfter,
  kSideBefore,
  kSpeedUp,
  kTable,
  kTableMarkdown,
  kTopAfter,
  kTopBefore,
  kTrajectoryKitti,
  kTrajectoryPicture,
  kTrajectory,
  kLiveTrajectory,
  kTruth,
};

/// Its name, in any folder.
std::string_view NameOf(ResultFile file);

/// Whether it is the name of one.
bool IsResultFile(std::string_view name);

inline std::filesystem::path operator/(const std::filesystem::path& folder, ResultFile file) {
  return folder / NameOf(file);
}

}  // namespace qwsm::pipeline
