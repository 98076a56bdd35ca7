// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/comparison_report.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>
#include <vector>

#include "service/config/text_table.hpp"
#include "service/io/files/csv_row.hpp"
#include "service/pipeline/results/run_report.hpp"

namespace qwsm::pipeline {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The first contestant beside another.
struct Duel {
  std::string_view candidate;
  std::string_view baseline;
  MatcherComparison comparison;
};

std::vector<Duel> Duels(const std::list<Contestant>& contestants) {
  std::vector<Duel> duels;
  const Contestant& first = contestants.front();
  for (auto other = std::next(contestants.begin()); other != contestants.end(); ++other) {
    duels.push_back({.candidate = Name(first.matcher()),
                     .baseline = Name(other->matcher()),
                     .comparison = CompareMatchers(first.figures.scans(), other->figures.scans())});
  }
  return duels;
}

std::string MatcherTable(const std::list<Contestant>& contestants) {
  Rows rows{{"matcher",
             "matched",
             "failed",
             "residual (mm)",
             "trace (mm^2)",
             "median (ms)",
             "p99 (ms)",
             "map points"}};
  for (const Contestant& contestant : contestants) {
    const RunStatistics& run = contestant.results.statistics();
    const bool has_scans = run.scans() > 0;
    rows.push_back(
        {std::string(Name(contestant.matcher())),
         fmt::format("{}", run.Count(StepStatus::kMatched) + run.Count(StepStatus::kExtended)),
         fmt::format("{}", run.Count(StepStatus::kDeadReckoned)),
         fmt::format("{:.2f}", run.MeanResidual_mm()),
         fmt::format("{:.3g}", run.MeanTrace_m2() * 1e6),
         fmt::format("{:.3f}", has_scans ? run.TimeQuantile_ms(0.5) : 0.0),
         fmt::format("{:.3f}", has_scans ? run.TimeQuantile_ms(0.99) : 0.0),
         fmt::format("{}", contestant.mapper.map().surfaces().quadtree().size())});
  }
  return config::FormatTable(rows);
}

}  // namespace

std::string ComparisonCsv(const std::list<Contestant>& contestants) {
  io::CsvRow header;
  header.Add("stamp_s");
  for (const Contestant& contestant : contestants) {
    for (const std::string_view column : {"status", "residual_mm", "trace", "ms"}) {
      header.Add(fmt::format("{}_{}", Name(contestant.matcher()), column));
    }
  }
  std::string text = header.Finish();
  const std::size_t scans = contestants.front().figures.scans().size();
  for (std::size_t i = 0; i < scans; ++i) {
    io::CsvRow row;
    row.Add(contestants.front().figures.scans()[i].stamp);
    for (const Contestant& contestant : contestants) {
      const ScanFigures& figures = contestant.figures.scans()[i];
      row.Add(Name(figures.status));
      for (const double value : {figures.residual_mm, figures.trace_m2, figures.duration_ms}) {
        row.Add(value);
      }
    }
    text += row.Finish();
  }
  return text;
}

std::string ComparisonJson(const std::list<Contestant>& contestants) {
  Json json;
  for (const Contestant& contestant : contestants) {
    json["matchers"].Add(MetricsJson(contestant.results.statistics(),
                                     FiguresOf(contestant.mapper.map()),
                                     contestant.matcher(),
                                     contestant.results.truth_report()));
  }
  for (const Duel& duel : Duels(contestants)) {
    const MatcherComparison& comparison = duel.comparison;
    Json figures;
    figures["matcher"] = duel.candidate;
    figures["baseline"] = duel.baseline;
    figures["scans"] = comparison.scans;
    figures["residual_ratio"] = comparison.residual_ratio;
    figures["trace_ratio"] = comparison.trace_ratio;
    figures["residual_smaller_share"] = comparison.smaller_residual_share;
    figures["trace_smaller_share"] = comparison.smaller_trace_share;
    json["comparisons"].Add(figures);
  }
  return json.Text();
}

std::string ComparisonText(const std::list<Contestant>& contestants) {
  Rows rows{{"over the scans that both matched",
             "scans",
             "residual ratio",
             "smaller in",
             "trace ratio",
             "smaller in"}};
  for (const Duel& duel : Duels(contestants)) {
    const MatcherComparison& comparison = duel.comparison;
    rows.push_back({fmt::format("{} against {}", duel.candidate, duel.baseline),
                    fmt::format("{}", comparison.scans),
                    fmt::format("{:.3f}", comparison.residual_ratio),
                    fmt::format("{:.1f} %", 100.0 * comparison.smaller_residual_share),
                    fmt::format("{:.3f}", comparison.trace_ratio),
                    fmt::format("{:.1f} %", 100.0 * comparison.smaller_trace_share)});
  }
  return MatcherTable(contestants) + "\n" + config::FormatTable(rows);
}

}  // namespace qwsm::pipeline
