// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "qwsm/geometry/angle.hpp"
#include "service/config/text_table.hpp"
#include "service/io/files/number_text.hpp"
#include "service/pipeline/evaluation/evaluation.hpp"
#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {
namespace {

using Rows = std::vector<std::vector<std::string>>;

const double kDegrees = RadiansToDegrees(1.0);

/// One metric of one trajectory, as it is called in tables and in JSON.
struct Metric {
  std::string name;
  std::string unit;
  const ErrorStatistics& errors;
  double scale = 1.0;
};

std::vector<Metric> MetricsOf(const Evaluation& evaluation) {
  std::vector<Metric> metrics;
  if (evaluation.relations) {
    const RelationsResult& relations = *evaluation.relations;
    metrics.push_back({"relations translation", "m", relations.all.translation_m});
    metrics.push_back({"relations rotation", "deg", relations.all.rotation_rad, kDegrees});
  }
  if (evaluation.absolute_m) metrics.push_back({"ate", "m", *evaluation.absolute_m});
  if (evaluation.relative) {
    metrics.push_back({"rpe translation", "m", evaluation.relative->translation_m});
    metrics.push_back({"rpe rotation", "deg", evaluation.relative->rotation_rad, kDegrees});
  }
  return metrics;
}

void AddRow(const Metric& metric, const std::string& trajectory, Rows& rows) {
  const ErrorStatistics& errors = metric.errors;
  std::vector<std::string> row{metric.name, metric.unit, fmt::format("{}", errors.count)};
  for (const double value : {errors.mean,
                             errors.standard_deviation,
                             errors.rmse,
                             errors.median,
                             errors.percentile_95,
                             errors.min,
                             errors.max}) {
    row.push_back(fmt::format("{:.4f}", value * metric.scale));
  }
  row.push_back(trajectory);
  rows.push_back(std::move(row));
}

Json ToJson(const ErrorStatistics& errors, const std::string& unit, double scale = 1.0) {
  Json json;
  json["count"] = errors.count;
  json["mean_" + unit] = errors.mean * scale;
  json["std_" + unit] = errors.standard_deviation * scale;
  json["rmse_" + unit] = errors.rmse * scale;
  json["median_" + unit] = errors.median * scale;
  json["p95_" + unit] = errors.percentile_95 * scale;
  json["min_" + unit] = errors.min * scale;
  json["max_" + unit] = errors.max * scale;
  return json;
}

Json ToJson(const RelationsSummary& summary) {
  Json json;
  json["translation"] = ToJson(summary.translation_m, "m");
  json["translation_squared"] = ToJson(summary.translation_squared_m2, "m2");
  json["rotation"] = ToJson(summary.rotation_rad, "deg", kDegrees);
  json["rotation_squared"] = ToJson(summary.rotation_squared_rad2, "deg2", kDegrees * kDegrees);
  return json;
}

Json ToJson(const RelationsResult& relations) {
  Json json = ToJson(relations.all);
  json["local"] = ToJson(relations.local);
  json["global"] = ToJson(relations.global);
  json["skipped"] = relations.skipped;
  return json;
}

/// A note of poses at the same time; nothing where there are none.
std::string NoteOf(const RepeatedStamps& repeated, const std::string& trajectory) {
  if (repeated.count == 0) return {};
  std::string stamp;
  io::AppendStamp(stamp, repeated.first);
  return fmt::format(
      "{}: {} poses have the stamp of another one, that of {} first; only the first of a stamp "
      "counts by relations, and where the other trajectory has fewer poses\n",
      trajectory,
      repeated.count,
      stamp);
}

}  // namespace

std::string EvaluationTable(std::span<const Evaluation> evaluations) {
  Rows rows{{"metric",
             "unit",
             "count",
             "mean",
             "std",
             "rmse",
             "median",
             "p95",
             "min",
             "max",
             "trajectory"}};
  std::string notes;
  for (const Evaluation& evaluation : evaluations) {
    for (const Metric& metric : MetricsOf(evaluation)) AddRow(metric, evaluation.trajectory, rows);
    const std::size_t skipped = evaluation.relations ? evaluation.relations->skipped : 0;
    if (skipped > 0) {
      notes += fmt::format(
          "{}: {} relations skipped: no pose at their stamps\n", evaluation.trajectory, skipped);
    }
    if (evaluation.unpaired > 0) {
      notes += fmt::format(
          "{}: {} poses skipped: trajectory and truth have none within --max-time-diff of them\n",
          evaluation.trajectory,
          evaluation.unpaired);
    }
    notes += NoteOf(evaluation.repeated, evaluation.trajectory);
  }
  if (!evaluations.empty()) {  // Of one truth, all of them.
    notes += NoteOf(evaluations.front().truth_repeated, evaluations.front().truth);
  }
  return config::FormatTable(rows) + notes;
}

std::string EvaluationJson(std::span<const Evaluation> evaluations) {
  Json list = Json::Array();
  for (const Evaluation& evaluation : evaluations) {
    Json json;
    json["trajectory"] = evaluation.trajectory;
    json["poses_repeated"] = evaluation.repeated.count;
    if (evaluation.absolute_m) json["truth_repeated"] = evaluation.truth_repeated.count;
    if (evaluation.relations) json["relations"] = ToJson(*evaluation.relations);
    if (evaluation.absolute_m) json["poses_skipped"] = evaluation.unpaired;
    if (evaluation.absolute_m) json["ate"] = ToJson(*evaluation.absolute_m, "m");
    if (evaluation.relative) {
      json["rpe"]["translation"] = ToJson(evaluation.relative->translation_m, "m");
      json["rpe"]["rotation"] = ToJson(evaluation.relative->rotation_rad, "deg", kDegrees);
    }
    list.Add(std::move(json));
  }
  return list.Text();
}

}  // namespace qwsm::pipeline
