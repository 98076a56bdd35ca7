// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <span>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "service/pipeline/evaluation/matcher_comparison.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/run/replay.hpp"

namespace qwsm::pipeline {

/// A matcher in a contest, and what has come of it so far.
struct Contestant {
  Contestant(const MapperOptions& options, const ResultsFolder& folder)
      : mapper(options), results(folder) {}

  MatcherKind matcher() const { return mapper.options().matcher; }

  Mapper mapper;
  ResultsWriter results;
  FiguresSink figures;
};

/// Runs several matchers on the same observations; all else is alike.
class MatcherContest {
 public:
  /// Lets each matcher leave all results of a run in a folder of its name inside `folder`.
  /// @throws io::WriteError, as all functions of the class do.
  MatcherContest(const MapperOptions& options,
                 std::span<const MatcherKind> matchers,
                 const ResultsFolder& folder);

  /// The runs that Replay() is to make.
  std::vector<MappingRun> runs();

  const std::list<Contestant>& contestants() const { return contestants_; }

  /// Writes every matcher's results, and what compares them: figures per scan (comparison.csv), on
  /// average (metrics.json), and residuals as in Figure 4 of Visser et al. (2009) (residual.png).
  /// @param truth of the robot in a frame of its own; empty where it is not known.
  void Finish(const OccupancyGridOptions& rendering, const Trajectory& truth = {});

 private:
  ResultsFolder folder_;
  std::list<Contestant> contestants_;  // They do not move: runs() refer to them.
};

}  // namespace qwsm::pipeline
