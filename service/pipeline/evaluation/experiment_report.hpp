// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <vector>

#include "service/pipeline/evaluation/matcher_contest.hpp"

namespace qwsm::pipeline {

/// One matcher on the data of one seed, as section 4.1 of Visser et al. (2009) judges it, and by
/// the truth.
struct ExperimentRun {
  int seed = 0;
  MatcherKind matcher = MatcherKind::kQWsm;
  std::size_t scans = 0;
  std::size_t failures = 0;  ///< Scans that were dead-reckoned.
  double residual_mm = 0.0;  ///< Mean residual over the scans that the matcher matched.
  double trace_m2 = 0.0;     ///< Mean PositionTrace_m2() over the scans that the matcher matched.
  MatcherComparison to_baseline;  ///< Comparison over the scans that both matched.
  TruthReport truth;
  double ms_median = 0.0;
};

/// The runs of a finished contest, whose last contestant is the baseline, in their order.
/// @pre the truth is known to it, and there are two contestants at least
std::vector<ExperimentRun> RunsOf(const std::list<Contestant>& contestants, int seed);

/// JSON: an array with one object per seed and matcher; every name ends in its unit. Names are only
/// ever added.
std::string ExperimentJson(const std::vector<ExperimentRun>& runs);

/// A table for programs with one line per seed and matcher. @pre there is a run
std::string ExperimentCsv(const std::vector<ExperimentRun>& runs);

// All functions below require a run.

/// A table for people: median and largest figures of each matcher, then every run.
std::string ExperimentText(const std::vector<ExperimentRun>& runs);

/// A table in Markdown: median and largest figures of each matcher, then every run.
std::string ExperimentMarkdown(const std::vector<ExperimentRun>& runs);

}  // namespace qwsm::pipeline
