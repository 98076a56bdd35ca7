// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// A scan that one wants to look at, and what the mapper made of it.
struct DoubtfulScan {
  std::size_t number = 0;  ///< Number in the run, from 0.
  StepStatus status = StepStatus::kMatched;
  std::string reason;  ///< Why that status, in words.
  double residual_m = 0.0;
  double overlap = 0.0;
  int pairs = 0;
  LaserScan scan;
};

/// Keeps the worst scans of a run with their readings: those that could not be matched first, then
/// those whose points stay farthest from the map. Of scans close after each other, which mostly
/// suffer from the same, only the worst is kept.
class DoubtfulScans final : public StepSink {
 public:
  static constexpr std::size_t kMost = 12;   ///< So many are kept.
  static constexpr std::size_t kApart = 20;  ///< Scans nearer than this to a worse one are not.

  void Take(const TimedStep& timed) override;

  /// The scans, the worst first.
  std::vector<DoubtfulScan> Worst() const;

 private:
  std::size_t taken_ = 0;
  std::vector<DoubtfulScan> kept_;  // In the order in which they were taken.
};

}  // namespace qwsm::pipeline
