// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/evaluation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "qwsm/metrics/pose_lookup.hpp"
#include "service/io/logs/evaluation_odometry.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/result_file.hpp"

namespace qwsm::pipeline {
namespace {

RepeatedStamps RepeatedIn(const Trajectory& trajectory) {
  RepeatedStamps repeated;
  const Trajectory sorted = SortedByStamp(trajectory);
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto next = std::find_if(
        first, sorted.end(), [&](const StampedPose2& pose) { return pose.stamp != first->stamp; });
    const auto others =
        std::count_if(first, next, [&](const StampedPose2& pose) { return pose != *first; });
    if (repeated.count == 0 && others > 0) repeated.first = first->stamp;
    repeated.count += static_cast<std::size_t>(others);
    first = next;
  }
  return repeated;
}

}  // namespace

Evaluator::Evaluator(EvaluationOptions options) : options_(std::move(options)) {
  if (options_.relations) relations_ = io::ReadRelationsFile(*options_.relations);
  if (options_.truth) truth_ = io::ReadTumFile(*options_.truth);
  truth_repeated_ = RepeatedIn(truth_);
}

Evaluation Evaluator::Evaluate(const std::filesystem::path& file) const {
  const bool is_folder = std::filesystem::is_directory(file);
  const Trajectory trajectory = io::ReadTumFile(is_folder ? file / ResultFile::kTrajectory : file);
  Evaluation evaluation{.trajectory = file.string(),
                        .relations = {},
                        .absolute_m = {},
                        .relative = {},
                        .repeated = RepeatedIn(trajectory)};
  if (options_.relations) {
    try {
      evaluation.relations = EvaluateAtRelations(trajectory);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(file.string() + ": " + error.what());
    }
    if (evaluation.relations->errors.empty()) {
      throw std::runtime_error(
          file.string() + ": no relation of " + options_.relations->string() +
          " is between stamps of this trajectory" +
          (options_.log ? "" : "; --log LOG carries it to those between scans"));
    }
  }
  if (options_.truth) {
    evaluation.truth = options_.truth->string();
    evaluation.truth_repeated = truth_repeated_;
    const std::vector<PosePair> pairs = Associate(truth_, trajectory, options_.max_time_difference);
    if (pairs.empty()) {
      throw std::runtime_error(file.string() + ": has no stamp in common with " +
                               options_.truth->string());
    }
    evaluation.unpaired = std::min(truth_.size(), trajectory.size()) - pairs.size();
    const Pose2 T_ref_map = options_.align ? AlignUmeyama(pairs) : Pose2{};
    evaluation.absolute_m = AbsoluteTrajectoryError(pairs, T_ref_map);
    evaluation.relative = EvaluateRelativePoses(pairs, options_.relative_step);
  }
  return evaluation;
}

RelationsResult Evaluator::EvaluateAtRelations(const Trajectory& trajectory) const {
  if (!options_.log) return EvaluateRelations(relations_, trajectory);
  const std::unique_ptr<io::LogReader> log = io::OpenLog(*options_.log);
  return EvaluateRelations(relations_, io::CarryToOdometry(*log, trajectory));
}

}  // namespace qwsm::pipeline
