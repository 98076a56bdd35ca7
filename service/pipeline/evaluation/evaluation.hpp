// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "qwsm/metrics/relations.hpp"
#include "qwsm/metrics/trajectory_error.hpp"

namespace qwsm::pipeline {

/// Says what trajectories are compared with.
struct EvaluationOptions {
  std::optional<std::filesystem::path> relations;
  /// Log whose odometry carries poses to stamps between scans.
  std::optional<std::filesystem::path> log;
  std::optional<std::filesystem::path> truth;  ///< A TUM trajectory.
  bool align = false;  ///< Move the trajectory onto the truth before its error is taken.
  std::chrono::nanoseconds max_time_difference = std::chrono::milliseconds(10);
  std::size_t relative_step = 1;  ///< Poses between the two ends of a relative pose error.
};

/// Poses of a trajectory at the same time as one before them, and elsewhere: of two lasers, of two
/// runs in one file, of stamps that were rounded.
struct RepeatedStamps {
  std::size_t count = 0;
  Timestamp first{};  ///< The first stamp that repeats.
};

/// How good one trajectory is; what was not asked for is absent.
struct Evaluation {
  std::string trajectory;
  std::optional<RelationsResult> relations;
  std::optional<ErrorStatistics> absolute_m;
  std::optional<RelativePoseError> relative;
  /// Poses without a true one at their time, or the other way round, of whichever are fewer.
  std::size_t unpaired = 0;
  RepeatedStamps repeated{};
  std::string truth{};  ///< What it was compared with.
  RepeatedStamps truth_repeated{};
};

/// Compares trajectories with what is known to be true.
class Evaluator {
 public:
  /// Reads what trajectories are compared with.
  /// @throws std::runtime_error where a file cannot be read.
  explicit Evaluator(EvaluationOptions options);

  /// Compares one trajectory.
  /// @param file a TUM trajectory, or a folder of results that holds one.
  /// @throws std::runtime_error where it cannot be read or has nothing in common with the truth.
  Evaluation Evaluate(const std::filesystem::path& file) const;

 private:
  RelationsResult EvaluateAtRelations(const Trajectory& trajectory) const;

  EvaluationOptions options_;
  std::vector<Relation> relations_;
  Trajectory truth_;
  RepeatedStamps truth_repeated_;
};

/// A line per trajectory and metric, with units: metres and degrees.
std::string EvaluationTable(std::span<const Evaluation> evaluations);

/// The evaluations as JSON; every name ends in its unit.
std::string EvaluationJson(std::span<const Evaluation> evaluations);

}  // namespace qwsm::pipeline
