// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/experiment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string_view>
#include <utility>

#include "qwsm/metrics/error_statistics.hpp"
#include "service/config/text_table.hpp"
#include "service/io/files/csv_row.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// One figure of a run, as it is called in files, and how it is shown.
struct Figure {
  std::string_view name;
  std::string_view title;
  double value = 0.0;
  int decimals = 0;
};

std::vector<Figure> FiguresOf(const ExperimentRun& run) {
  const MatcherComparison& to_baseline = run.to_baseline;
  return {{"scans", "scans", static_cast<double>(run.scans)},
          {"failures", "failed", static_cast<double>(run.failures)},
          {"residual_mm", "residual (mm)", run.residual_mm, 2},
          {"residual_ratio", "ratio", to_baseline.residual_ratio, 3},
          {"trace_mm2", "trace (mm^2)", run.trace_m2 * 1e6, 0},
          {"trace_ratio", "ratio", to_baseline.trace_ratio, 3},
          {"trace_smaller_share", "smaller in", to_baseline.smaller_trace_share, 3},
          {"loop_gap_m", "gap (m)", run.truth.loop_gap_m, 3},
          {"ate_rmse_m", "ATE (m)", run.truth.ate_rmse_m, 3},
          {"ate_from_start_rmse_m", "from start", run.truth.ate_from_start_rmse_m, 3},
          {"nees", "NEES", run.truth.nees.mean, 2},
          {"ms_median", "ms", run.ms_median, 3}};
}

std::vector<ExperimentRun> RunsWith(const std::vector<ExperimentRun>& runs, MatcherKind matcher) {
  std::vector<ExperimentRun> own;
  std::ranges::copy_if(runs, std::back_inserter(own), [=](const ExperimentRun& run) {
    return run.matcher == matcher;
  });
  return own;
}

std::vector<MatcherKind> MatchersOf(const std::vector<ExperimentRun>& runs) {
  std::vector<MatcherKind> matchers;
  for (const ExperimentRun& run : runs) {
    if (std::ranges::find(matchers, run.matcher) == matchers.end()) matchers.push_back(run.matcher);
  }
  return matchers;
}

/// The figures of all runs of a matcher, one column each, brought down to one number.
template <class Reduce>
std::vector<std::string> ReducedRow(const std::vector<ExperimentRun>& runs, const Reduce& reduce) {
  std::vector<std::string> row;
  const std::vector<Figure> first = FiguresOf(runs.front());
  for (std::size_t i = 0; i < first.size(); ++i) {
    std::vector<double> values;
    for (const ExperimentRun& run : runs) values.push_back(FiguresOf(run)[i].value);
    row.push_back(fmt::format("{:.{}f}", reduce(std::move(values)), first[i].decimals));
  }
  return row;
}

std::vector<std::string> Heading(const ExperimentRun& run) {
  std::vector<std::string> row{"matcher", "seed"};
  for (const Figure& figure : FiguresOf(run)) row.emplace_back(figure.title);
  return row;
}

/// Median and worst of every matcher, then every run.
Rows TableOf(const std::vector<ExperimentRun>& runs) {
  Rows rows{Heading(runs.front())};
  const auto add = [&](MatcherKind matcher, const std::string& what, std::vector<std::string> row) {
    row.insert(row.begin(), {std::string(Name(matcher)), what});
    rows.push_back(std::move(row));
  };
  const auto median = [](std::vector<double> values) {
    return Summarize(std::move(values)).median;
  };
  const auto largest = [](const std::vector<double>& values) { return std::ranges::max(values); };
  for (const MatcherKind matcher : MatchersOf(runs)) {
    const std::vector<ExperimentRun> own = RunsWith(runs, matcher);
    add(matcher, "median", ReducedRow(own, median));
    add(matcher, "largest", ReducedRow(own, largest));
  }
  for (const ExperimentRun& run : runs) {
    add(run.matcher, fmt::format("{}", run.seed), ReducedRow({run}, largest));
  }
  return rows;
}

}  // namespace

std::vector<ExperimentRun> RunsOf(const std::list<Contestant>& contestants, int seed) {
  assert(contestants.size() >= 2 && "there is a baseline");
  std::vector<ExperimentRun> runs;
  const Contestant& baseline = contestants.back();
  for (const Contestant& contestant : contestants) {
    const RunStatistics& statistics = contestant.results.statistics();
    runs.push_back(
        {.seed = seed,
         .matcher = contestant.matcher(),
         .scans = statistics.scans(),
         .failures = statistics.Count(StepStatus::kDeadReckoned),
         .residual_mm = statistics.MeanResidual_mm(),
         .trace_m2 = statistics.MeanTrace_m2(),
         .to_baseline = CompareMatchers(contestant.figures.scans(), baseline.figures.scans()),
         .truth = contestant.results.truth_report().value_or(TruthReport{}),
         .ms_median = statistics.scans() > 0 ? statistics.TimeQuantile_ms(0.5) : 0.0});
  }
  return runs;
}

std::string ExperimentJson(const std::vector<ExperimentRun>& runs) {
  Json json = Json::Array();
  for (const ExperimentRun& run : runs) {
    Json object;
    object["seed"] = run.seed;
    object["matcher"] = Name(run.matcher);
    for (const Figure& figure : FiguresOf(run)) object[figure.name] = figure.value;
    json.Add(std::move(object));
  }
  return json.Text();
}

std::string ExperimentCsv(const std::vector<ExperimentRun>& runs) {
  io::CsvRow header;
  header.Add("seed");
  header.Add("matcher");
  for (const Figure& figure : FiguresOf(runs.front())) header.Add(figure.name);
  std::string text = header.Finish();
  for (const ExperimentRun& run : runs) {
    io::CsvRow row;
    row.Add(static_cast<double>(run.seed));
    row.Add(Name(run.matcher));
    for (const Figure& figure : FiguresOf(run)) row.Add(figure.value);
    text += row.Finish();
  }
  return text;
}

std::string ExperimentText(const std::vector<ExperimentRun>& runs) {
  return config::FormatTable(TableOf(runs));
}

std::string ExperimentMarkdown(const std::vector<ExperimentRun>& runs) {
  std::string text;
  const Rows rows = TableOf(runs);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += fmt::format("| {} |\n", fmt::join(rows[i], " | "));
    if (i > 0) continue;
    for (std::size_t column = 0; column < rows[i].size(); ++column) text += "|---";
    text += "|\n";
  }
  return text;
}

}  // namespace qwsm::pipeline
