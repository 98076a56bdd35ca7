// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/relations.hpp"

#include <cmath>
#include <optional>

#include "qwsm/metrics/pose_lookup.hpp"

namespace qwsm {
namespace {

std::optional<Pose2> PoseAt(const Trajectory& sorted,
                            Timestamp stamp,
                            const RelationsOptions& options) {
  if (options.lookup == PoseLookup::kInterpolated) {
    return InterpolatedPose(sorted, stamp, options.tolerance);
  }
  const std::optional<std::size_t> index = NearestIndex(sorted, stamp, options.tolerance);
  if (!index) return std::nullopt;
  return sorted[*index].T_map_robot;
}

bool IsLocal(const Relation& relation, const RelationsOptions& options) {
  return std::chrono::abs(relation.second - relation.first) <= options.local_duration;
}

// The magnitudes of some relations' errors.
struct Magnitudes {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;

  void Add(const RelationError& error) {
    translation_m.push_back(error.translation_m);
    rotation_rad.push_back(error.rotation_rad);
  }

  RelationsSummary Summary() const {
    return {.translation_m = Summarize(translation_m),
            .translation_squared_m2 = SummarizeSquares(translation_m),
            .rotation_rad = Summarize(rotation_rad),
            .rotation_squared_rad2 = SummarizeSquares(rotation_rad)};
  }
};

}  // namespace

RelationsResult EvaluateRelations(std::span<const Relation> relations,
                                  Trajectory trajectory,
                                  const RelationsOptions& options) {
  const Trajectory sorted = SortedByStamp(std::move(trajectory));
  RelationsResult result;
  Magnitudes all;
  Magnitudes local;
  Magnitudes global;
  for (std::size_t index = 0; index < relations.size(); ++index) {
    const Relation& relation = relations[index];
    const std::optional<Pose2> T_map_first = PoseAt(sorted, relation.first, options);
    const std::optional<Pose2> T_map_second = PoseAt(sorted, relation.second, options);
    if (!T_map_first || !T_map_second) {
      ++result.skipped;
      continue;
    }
    const Pose2 T_first_second = T_map_first->Inverse() * *T_map_second;
    const Pose2 error = relation.T_first_second.Inverse() * T_first_second;
    result.errors.push_back({.relation = index,
                             .translation_m = error.translation_m().norm(),
                             .rotation_rad = std::abs(error.theta_rad)});
    all.Add(result.errors.back());
    (IsLocal(relation, options) ? local : global).Add(result.errors.back());
  }
  result.all = all.Summary();
  result.local = local.Summary();
  result.global = global.Summary();
  return result;
}

}  // namespace qwsm
