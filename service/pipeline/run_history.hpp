// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "service/io/residual_plot.hpp"
#include "service/io/trajectory_picture.hpp"
#include "service/pipeline/step_sink.hpp"

namespace qwsm::pipeline {

/// Keeps of a run what pictures are drawn from.
class RunHistory final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  const io::MapOverlay& overlay() const { return overlay_; }
  /// Per scan; NaN where there was no match.
  const std::vector<double>& residuals_mm() const { return residuals_mm_; }

 private:
  io::MapOverlay overlay_;
  std::vector<double> residuals_mm_;
  std::optional<Pose2> T_map_odom_;  // By the first scan that has odometry.
};

}  // namespace qwsm::pipeline
