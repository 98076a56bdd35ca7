// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/metrics/error_statistics.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm {

/// The true pose of the robot at `second` seen from where it was at `first`.
struct Relation {
  Timestamp first{};
  Timestamp second{};
  Pose2 T_first_second;
};

/// How the pose at a relation's stamp is taken from a trajectory.
enum class PoseLookup {
  kNearest,       ///< The nearest pose, if it is within the tolerance.
  kInterpolated,  ///< Between its neighbours; the tolerance counts beyond the ends only.
};

struct RelationsOptions {
  PoseLookup lookup = PoseLookup::kNearest;
  std::chrono::nanoseconds tolerance = std::chrono::microseconds(600);
  /// A relation between poses at most this far apart in time tells about local consistency, any
  /// other about global consistency.
  std::chrono::nanoseconds local_duration = std::chrono::seconds(10);
};

/// How wrong a trajectory is about one relation.
struct RelationError {
  std::size_t relation = 0;  ///< Index into the relations.
  double translation_m = 0.0;
  double rotation_rad = 0.0;
};

struct RelationsSummary {
  ErrorStatistics translation_m;
  ErrorStatistics translation_squared_m2;
  ErrorStatistics rotation_rad;
  ErrorStatistics rotation_squared_rad2;
};

struct RelationsResult {
  RelationsSummary all;
  RelationsSummary local;
  RelationsSummary global;
  std::size_t skipped = 0;            ///< Relations whose stamps the trajectory does not cover.
  std::vector<RelationError> errors;  ///< Errors of the relations not skipped, in their order.
};

/// The relations metric of Kuemmerle et al. (2009), Eq. (4): the error of a relation is
/// e = T_first_second^-1 * (T_map_first^-1 * T_map_second), reported as |translation| and
/// |rotation|. It does not depend on the map's frame, and drift counts once, not ever after. The
/// trajectory may be in any order. O((n + m) log n) for n poses and m relations.
RelationsResult EvaluateRelations(std::span<const Relation> relations,
                                  Trajectory trajectory,
                                  const RelationsOptions& options = {});

}  // namespace qwsm
