// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "service/io/pictures/residual_plot.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/pipeline/run/step_sink.hpp"
#include "service/pipeline/run/thinned_series.hpp"

namespace qwsm::pipeline {

/// Keeps of a run what pictures are drawn from.
class RunHistory final : public StepSink {
 public:
  /// Limit that keeps all of a recorded log.
  static constexpr std::size_t kAll = std::size_t{1} << 40U;

  /// Keeps no poses yet. @param most poses that are kept, evenly spread; even.
  explicit RunHistory(std::size_t most = kAll)
      : path_(most), odometry_(most), residuals_mm_(most), times_ms_(most) {}

  void Take(const TimedStep& timed) override;

  const std::vector<io::PathPose>& path() const { return path_.elements(); }
  /// Path and odometry as they are drawn over a map.
  io::MapOverlay Overlay() const&;
  /// Likewise, without a second copy of them: they are not kept any more.
  io::MapOverlay Overlay() &&;
  /// The residual of each scan, in mm; NaN where there was no match.
  const std::vector<double>& residuals_mm() const { return residuals_mm_.elements(); }
  /// The processor time that each scan took, in ms.
  const std::vector<double>& times_ms() const { return times_ms_.elements(); }

 private:
  ThinnedSeries<io::PathPose> path_;
  ThinnedSeries<StampedPose2> odometry_;
  ThinnedSeries<double> residuals_mm_;
  ThinnedSeries<double> times_ms_;
  // Odometry's place in the map, by the first scan that has odometry.
  std::optional<Pose2> T_map_odom_;
};

}  // namespace qwsm::pipeline
