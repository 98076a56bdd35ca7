// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/evaluation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "service/io/logs/evaluation_odometry.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/result_file.hpp"

namespace qwsm::pipeline {

Evaluator::Evaluator(EvaluationOptions options) : options_(std::move(options)) {
  if (options_.relations) relations_ = io::ReadRelationsFile(*options_.relations);
  if (options_.truth) truth_ = io::ReadTumFile(*options_.truth);
}

Evaluation Evaluator::Evaluate(const std::filesystem::path& file) const {
  const bool is_folder = std::filesystem::is_directory(file);
  const Trajectory trajectory = io::ReadTumFile(is_folder ? file / ResultFile::kTrajectory : file);
  Evaluation evaluation{
      .trajectory = file.string(), .relations = {}, .absolute_m = {}, .relative = {}};
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
