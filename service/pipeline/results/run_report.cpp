// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "qwsm/geometry/angle.hpp"
#include "service/pipeline/run/progress_display.hpp"

namespace qwsm::pipeline {
namespace {

double ScansPerSecond(const RunStatistics& run) {
  const double time_s = run.total_time_s();
  return time_s > 0.0 ? static_cast<double>(run.scans()) / time_s : 0.0;
}

std::string Corrected(const LoopCounts& loops) {
  if (loops.accepted == 0) return "stay as they were answered";
  if (loops.epochs == 0) return "are corrected";
  return fmt::format("are corrected, {} while the robot drove",
                     loops.epochs == 1 ? "once" : fmt::format("{} times", loops.epochs));
}

void AddTo(Json& json, const TruthReport& truth) {
  json["ate_rmse_m"] = truth.ate_rmse_m;
  json["ate_from_start_rmse_m"] = truth.ate_from_start_rmse_m;
  json["heading_rmse_deg"] = RadiansToDegrees(truth.heading_rmse_rad);
  json["loop_gap_m"] = truth.loop_gap_m;
  json["nees"] = truth.nees.mean;
  json["share_in_95_percent_ellipsoid"] = truth.nees.share_in_95_percent_ellipsoid;
}

}  // namespace

std::string_view Name(MatcherKind matcher) {
  const auto found =
      std::ranges::find(Names(matcher), matcher, [](const auto& named) { return named.second; });
  return found->first;
}

Json MetricsJson(const RunStatistics& run,
                 const MapFigures& map,
                 MatcherKind matcher,
                 const std::optional<TruthReport>& truth,
                 const std::optional<LoopCounts>& loops) {
  Json json;
  json["matcher"] = Name(matcher);
  json["scans"] = run.scans();
  json["matched"] = run.Count(StepStatus::kMatched);
  json["extended"] = run.Count(StepStatus::kExtended);
  json["dead_reckoned"] = run.Count(StepStatus::kDeadReckoned);
  json["lost"] = run.Count(StepStatus::kLost);
  json["relevant"] = run.relevant();
  json["path_length_m"] = run.path_length_m();
  json["mean_residual_mm"] = run.MeanResidual_mm();
  json["mean_trace_m2"] = run.MeanTrace_m2();
  json["scans_per_s"] = ScansPerSecond(run);
  json["drive_s"] = run.drive_time_s();
  if (run.scans() > 0) {
    json["ms_median"] = run.TimeQuantile_ms(0.5);
    json["ms_p99"] = run.TimeQuantile_ms(0.99);
    json["ms_max"] = run.longest_time_ms();
  }
  json["map"]["points"] = map.points.points;
  json["map"]["scans"] = map.scans;
  json["map"]["quadtree_nodes"] = map.points.nodes;
  json["map"]["quadtree_depth"] = map.points.depth;
  json["map"]["quadtree_bytes"] = map.points.bytes;
  if (loops) {
    json["loops"]["found"] = loops->found;
    json["loops"]["accepted"] = loops->accepted;
    json["corrections_while_driving"] = loops->epochs;
  }
  if (truth) AddTo(json, *truth);
  return json;
}

std::string SummaryText(const RunStatistics& run,
                        const MapFigures& map,
                        const std::optional<TruthReport>& truth,
                        const std::optional<LoopCounts>& loops) {
  std::string text = fmt::format("scans          {}", WithThousands(run.scans()));
  if (run.scans() == 0) return text + "\n";
  text += fmt::format(", {:.0f} per second (median {:.2f} ms, p99 {:.2f} ms, longest {:.1f} ms)\n",
                      ScansPerSecond(run),
                      run.TimeQuantile_ms(0.5),
                      run.TimeQuantile_ms(0.99),
                      run.longest_time_ms());
  if (run.is_outrun()) {
    text += fmt::format("too slow       {:.1f} s of work for {:.1f} s of driving\n",
                        run.total_time_s(),
                        run.drive_time_s());
  }
  text += fmt::format("path           {:.1f} m\n", run.path_length_m());
  text +=
      fmt::format("matched        {}, of which {} showed much that is new\n",
                  WithThousands(run.Count(StepStatus::kMatched) + run.Count(StepStatus::kExtended)),
                  WithThousands(run.Count(StepStatus::kExtended)));
  text += fmt::format("dead-reckoned  {}\n", WithThousands(run.Count(StepStatus::kDeadReckoned)));
  if (run.Count(StepStatus::kLost) > 0) {
    text += fmt::format("lost           {}, {}\n",
                        WithThousands(run.Count(StepStatus::kLost)),
                        run.lost_at_end() == 0
                            ? "and placed once the robot was found"
                            : fmt::format("of which the last {} are on a path of their own: the "
                                          "robot was not found again",
                                          WithThousands(run.lost_at_end())));
  }
  text += fmt::format("mean residual  {:.2f} mm\n", run.MeanResidual_mm());
  text += fmt::format("map            {} points of {} relevant scans, {:.1f} MB\n",
                      WithThousands(map.points.points),
                      WithThousands(map.scans),
                      static_cast<double>(map.points.bytes) * 1e-6);
  if (loops) {
    text += fmt::format("loops          {} accepted of {} found; path and map {}\n",
                        WithThousands(loops->accepted),
                        WithThousands(loops->found),
                        Corrected(*loops));
  }
  if (truth) {
    text += fmt::format(
        "truth          ATE {:.3f} m rmse, {:.3f} m from tip to tail; NEES {:.2f} (3 is right)\n",
        truth->ate_rmse_m,
        truth->loop_gap_m,
        truth->nees.mean);
  }
  return text;
}

}  // namespace qwsm::pipeline
