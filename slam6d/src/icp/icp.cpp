// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/icp/icp.hpp"

#include <cassert>
#include <memory>

#include "slam6d/src/icp/point_pairs.hpp"
#include "slam6d/src/icp/surfel_pairs.hpp"

namespace slam6d {
namespace {

std::unique_ptr<IcpMinimizer> MakeMinimizer(std::span<const IcpReference> references,
                                            const ScanModel& cur,
                                            const UncertainPose3& T_map_guess,
                                            const IcpOptions& options) {
  if (options.metric == IcpMetric::kPointToPoint) {
    return std::make_unique<JointMinimizer<PointPairs>>(references, cur, T_map_guess, options);
  }
  return std::make_unique<JointMinimizer<SurfelPairs>>(references, cur, T_map_guess, options);
}

/// A hundredth of what the pose is known to, squared: among trees pairs change to and fro for ever,
/// and move the pose by no more.
constexpr double kSmallChi2 = 1e-4;

bool IsSmall(const Pose3& before, const Pose3& after, const IcpOptions& options) {
  return (after.translation_m - before.translation_m).norm() < options.translation_tolerance_m &&
         RotationAngle(before.rotation.transpose() * after.rotation) <
             options.rotation_tolerance_rad;
}

IcpResult Stop(IcpResult result, IcpStatus status, const IcpMinimizer& minimizer) {
  result.status = status;
  result.search = minimizer.statistics();
  if (status == IcpStatus::kConverged || status == IcpStatus::kIterationLimit) {
    IcpKnowledge knowledge = minimizer.Knowledge();
    result.covariance = knowledge.covariance;
    result.told_by_references = std::move(knowledge.told_by_references);
  }
  return result;
}

}  // namespace

Matrix6d GuessCovariance(const IcpOptions& options) {
  Vector6d sigmas;
  sigmas << Eigen::Vector3d::Constant(options.guess_sigma_m),
      Eigen::Vector3d::Constant(options.guess_sigma_rad);
  return sigmas.cwiseAbs2().asDiagonal();
}

IcpResult Align(const ScanModel& ref,
                const ScanModel& cur,
                const Pose3& T_ref_cur_guess,
                const IcpOptions& options,
                IcpTrace* trace) {
  const IcpReference reference{.model = &ref, .T_map_ref = {}};
  return Align(std::span(&reference, 1), cur, T_ref_cur_guess, options, trace);
}

IcpResult Align(std::span<const IcpReference> references,
                const ScanModel& cur,
                const Pose3& T_map_cur_guess,
                const IcpOptions& options,
                IcpTrace* trace) {
  const UncertainPose3 guess{.T_a_b = T_map_cur_guess, .covariance = GuessCovariance(options)};
  return Align(references, cur, {.now = T_map_cur_guess, .guess = guess}, options, trace);
}

IcpResult Align(std::span<const IcpReference> references,
                const ScanModel& cur,
                const PoseAndGuess& T_map_cur,
                const IcpOptions& options,
                IcpTrace* trace) {
  assert(IsFinite(T_map_cur.now) && IsFinite(T_map_cur.guess.T_a_b) && "the guess is a pose");
  const std::unique_ptr<IcpMinimizer> minimizer =
      MakeMinimizer(references, cur, T_map_cur.guess, options);
  IcpResult result{.T_ref_cur = T_map_cur.now};
  if (trace != nullptr) trace->assign(1, T_map_cur.now);
  for (result.iterations = 1; result.iterations <= options.max_iterations; ++result.iterations) {
    // Nüchter et al. (2007), Algorithm 1, lines 2-13: pairs, from the root in the first iteration
    // and from the cache in later ones, and the motion that they ask for.
    const IcpStep step = minimizer->Iterate(result.T_ref_cur, result.iterations);
    result.pairs = step.pairs;
    result.rms_residual_m = step.rms_residual_m;
    if (step.pairs < static_cast<std::size_t>(options.min_pairs)) {
      return Stop(result, IcpStatus::kTooFewPairs, *minimizer);
    }
    if (!step.motion_map) return Stop(result, IcpStatus::kDegenerate, *minimizer);

    const Pose3 before = result.T_ref_cur;
    result.T_ref_cur = *step.motion_map * before;  // Line 14.
    result.T_ref_cur.rotation = NearestRotation(result.T_ref_cur.rotation);
    if (trace != nullptr) trace->push_back(result.T_ref_cur);
    const bool is_small =
        step.motion_chi2 < kSmallChi2 || IsSmall(before, result.T_ref_cur, options);
    if (step.settled && is_small) {
      return Stop(result, IcpStatus::kConverged, *minimizer);
    }
  }
  result.iterations = options.max_iterations;
  return Stop(result, IcpStatus::kIterationLimit, *minimizer);
}

}  // namespace slam6d
