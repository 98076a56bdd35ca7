// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/matcher_contest.hpp"

#include <functional>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/pictures/residual_plot.hpp"
#include "service/pipeline/evaluation/comparison_report.hpp"
#include "service/pipeline/results/result_file.hpp"
#include "service/pipeline/results/run_report.hpp"

namespace qwsm::pipeline {

MatcherContest::MatcherContest(const MapperOptions& options,
                               std::span<const MatcherKind> matchers,
                               const ResultsFolder& folder)
    : folder_(folder) {
  for (const MatcherKind matcher : matchers) {
    MapperOptions own = options;
    own.matcher = matcher;
    contestants_.emplace_back(own, folder.Part(std::string(Name(matcher)), false));
  }
}

std::vector<MappingRun> MatcherContest::runs() {
  std::vector<MappingRun> runs;
  for (Contestant& contestant : contestants_) {
    runs.push_back({.answer = std::bind_front(&Mapper::Process, &contestant.mapper),
                    .sinks = {&contestant.results, &contestant.figures}});
  }
  return runs;
}

void MatcherContest::Finish(const OccupancyGridOptions& rendering, const Trajectory& truth) {
  std::vector<io::ResidualSeries> residuals;
  for (Contestant& contestant : contestants_) {
    contestant.results.Finish(contestant.mapper.map(), contestant.matcher(), rendering, truth);
    // The first matcher stands in front, as in Figure 4 of Visser et al. (2009).
    residuals.insert(residuals.begin(),
                     {.name = std::string(Name(contestant.matcher())),
                      .residual_mm = contestant.figures.Residuals_mm()});
  }
  io::WriteResidualPlot(folder_ / ResultFile::kResiduals, residuals);
  io::WriteTextFile(folder_ / ResultFile::kComparison, ComparisonCsv(contestants_));
  io::WriteTextFile(folder_ / ResultFile::kMetrics, ComparisonJson(contestants_));
}

}  // namespace qwsm::pipeline
