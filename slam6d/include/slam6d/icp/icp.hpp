// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "slam6d/cloud/scan_model.hpp"
#include "slam6d/geometry/pose3.hpp"
#include "slam6d/icp/closed_form.hpp"
#include "slam6d/search/cached_search.hpp"

namespace slam6d {

/// Says what ICP minimises.
enum class IcpMetric {
  kPointToPoint,  ///< Nüchter et al. (2007), Eq. 1, in closed form.
  kPointToPlane,  ///< Distance of the points from the reference's surfels (Chen & Medioni 1991).
  /// Distance between surfels along the mean of their normals (as Rusinkiewicz 2019), weighted by
  /// the scatter of both (as GICP: Segal, Haehnel & Thrun 2009).
  kPlaneToPlane,
};

inline std::span<const std::pair<std::string_view, IcpMetric>> Names(IcpMetric) {
  static constexpr std::array<std::pair<std::string_view, IcpMetric>, 3> kNames{{
      {"point-to-point", IcpMetric::kPointToPoint},
      {"point-to-plane", IcpMetric::kPointToPlane},
      {"plane-to-plane", IcpMetric::kPlaneToPlane},
  }};
  return kNames;
}

struct IcpOptions {
  IcpMetric metric = IcpMetric::kPlaneToPlane;
  ClosedForm closed_form = ClosedForm::kSvd;  ///< The solution of point-to-point; all agree.
  SearchStart search = SearchStart::kCache;
  double max_distance_m = 0.5;  ///< Longer pairs do not count.
  int max_iterations = 100;
  /// ICP has converged when a step is below this and `rotation_tolerance_rad`.
  double translation_tolerance_m = 1e-5;
  double rotation_tolerance_rad = 1e-6;
  int min_pairs = 10;
  /// With point-to-point, pairs longer than this times the root mean square of the last iteration's
  /// do not count; 0 keeps them.
  double max_rms_ratio = 0.0;
  /// With surfels, residuals well above this lose their weight; it is wider in the first
  /// iterations.
  double residual_scale_m = 0.02;
  /// With surfels, what these are off by beside their scatter.
  double surface_noise_m = 0.001;
  /// With surfels, what the guess may be off by along each axis, or more to the side of a long way.
  /// It tells what the pairs leave open, as along a corridor.
  double guess_sigma_m = 0.3;
  double guess_sigma_rad = 0.1;
  int threads = 1;  ///< Working threads; they change no bit of the result.
};

template <class Visitor>
void Describe(Visitor& visit, IcpOptions& o) {
  visit("metric", o.metric, {.help = "what is minimised"});
  visit("closed_form", o.closed_form, {.help = "solution of point-to-point; all agree"});
  visit("max_distance_m",
        o.max_distance_m,
        {.help = "longer pairs do not count", .min = 0, .max = 1000});
  visit("max_iterations",
        o.max_iterations,
        {.help = "upper bound on iterations", .min = 1, .max = 10000});
  visit("translation_tolerance_m",
        o.translation_tolerance_m,
        {.help = "converged below", .min = 0, .max = 1});
  visit("rotation_tolerance_rad",
        o.rotation_tolerance_rad,
        {.help = "converged below", .min = 0, .max = 1});
  visit("min_pairs", o.min_pairs, {.help = "fewer pairs are no match", .min = 3, .max = 1e9});
  visit("max_rms_ratio",
        o.max_rms_ratio,
        {.help = "point-to-point: pairs longer than this times the root mean square are dropped; 0 "
                 "keeps them",
         .min = 0,
         .max = 100});
  visit("residual_scale_m",
        o.residual_scale_m,
        {.help = "to planes: larger residuals lose weight", .min = 1e-6, .max = 100});
  visit("surface_noise_m",
        o.surface_noise_m,
        {.help = "to planes: error of a surfel beside its scatter", .min = 1e-6, .max = 10});
  visit("guess_sigma_m",
        o.guess_sigma_m,
        {.help = "to planes: error of the guess, which tells what the pairs leave open",
         .min = 1e-3,
         .max = 1e3});
  visit("guess_sigma_rad",
        o.guess_sigma_rad,
        {.help = "to planes: the same of its rotation", .min = 1e-4, .max = 10});
  visit("threads", o.threads, {.help = "changes no bit of the result", .min = 1, .max = 256});
}

enum class IcpStatus {
  kConverged,
  kIterationLimit,
  kTooFewPairs,
  kDegenerate,  ///< The pairs leave some motion open.
};

/// The status in words for a person.
constexpr std::string_view Name(IcpStatus status) {
  switch (status) {
    case IcpStatus::kConverged:
      return "converged";
    case IcpStatus::kIterationLimit:
      return "the iteration limit was reached";
    case IcpStatus::kTooFewPairs:
      return "too few pairs within the maximum distance";
    case IcpStatus::kDegenerate:
      return "the pairs leave some motion open";
  }
  return "";
}

struct [[nodiscard]] IcpResult {
  IcpStatus status = IcpStatus::kTooFewPairs;
  Pose3 T_ref_cur;  ///< Best estimate so far, whatever the status.
  /// Covariance of (x, y, z, roll, pitch, yaw) as in UncertainPose3: to planes, by how far the pairs
  /// scatter, with that of the guess in what they leave open; to points, as if thirty of the pairs
  /// had independent errors of the size of the residuals. Zero, which says nothing, unless converged
  /// or stopped by the iteration limit.
  Matrix6d covariance = Matrix6d::Zero();
  /// The information on the pose from the pairs with each reference; empty without a covariance.
  /// With that of the guess they add up to the inverse of the covariance that ICP ended with.
  std::vector<Matrix6d> told_by_references{};
  int iterations = 0;
  std::size_t pairs = 0;
  double rms_residual_m = 0.0;
  SearchStatistics search{};
};

/// The pose after each iteration; the guess stands first.
using IcpTrace = std::vector<Pose3>;

/// Aligns `cur` with `ref`, beginning at a guess (Nüchter et al. 2007, section 3.3, and Algorithm 1
/// in section 4.1).
IcpResult Align(const ScanModel& ref,
                const ScanModel& cur,
                const Pose3& T_ref_cur_guess,
                const IcpOptions& options,
                IcpTrace* trace = nullptr);

/// A scan that stands still in the frame map.
struct IcpReference {
  const ScanModel* model;
  Pose3 T_map_ref;
};

/// Aligns `cur` with all references at once, beginning at a guess: each of its points is paired in
/// every reference. In the result, `ref` is the frame map.
IcpResult Align(std::span<const IcpReference> references,
                const ScanModel& cur,
                const Pose3& T_map_cur_guess,
                const IcpOptions& options,
                IcpTrace* trace = nullptr);

/// What a guess may be off by where nothing more is known of it than the options say.
Matrix6d GuessCovariance(const IcpOptions& options);

/// Where the current scan is thought to be by now, and where it was thought to be, and how surely,
/// before anything was known of its points: what these leave open is left to the guess.
struct PoseAndGuess {
  Pose3 now;
  UncertainPose3 guess;
};

/// The same, beginning somewhere else than at the guess.
IcpResult Align(std::span<const IcpReference> references,
                const ScanModel& cur,
                const PoseAndGuess& T_map_cur,
                const IcpOptions& options,
                IcpTrace* trace = nullptr);

}  // namespace slam6d
