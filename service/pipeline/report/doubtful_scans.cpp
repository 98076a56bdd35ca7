// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/report/doubtful_scans.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace qwsm::pipeline {
namespace {

bool IsWorse(const DoubtfulScan& a, const DoubtfulScan& b) {
  const auto badness = [](const DoubtfulScan& scan) {
    return std::tuple(scan.status == StepStatus::kDeadReckoned, scan.residual_m);
  };
  return badness(a) > badness(b);
}

}  // namespace

void DoubtfulScans::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  const std::size_t number = taken_++;
  if (timed.scan == nullptr) return;
  if (!HasMatch(step.status) && step.status != StepStatus::kDeadReckoned) return;
  DoubtfulScan scan{
      .number = number,
      .status = step.status,
      .reason = {},
      .residual_m = std::isfinite(step.match.mean_residual_m) ? step.match.mean_residual_m : 0.0,
      .overlap = step.match.overlap,
      .pairs = step.match.pairs,
      .scan = {}};
  auto place = kept_.end();
  if (!kept_.empty() && number - kept_.back().number < kApart) {
    place = std::prev(kept_.end());
  } else if (kept_.size() == kMost) {
    place = std::ranges::max_element(kept_, IsWorse);  // The least bad one.
  }
  if (place != kept_.end()) {
    if (!IsWorse(scan, *place)) return;
    kept_.erase(place);
  }
  scan.reason = step.reason;
  scan.scan = *timed.scan;
  kept_.push_back(std::move(scan));
}

std::vector<DoubtfulScan> DoubtfulScans::Worst() const {
  std::vector<DoubtfulScan> worst = kept_;
  std::ranges::sort(worst, IsWorse);
  return worst;
}

}  // namespace qwsm::pipeline
