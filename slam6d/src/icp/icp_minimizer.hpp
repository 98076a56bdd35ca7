// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam6d/icp/icp.hpp"
#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {

/// The outcome of one iteration.
struct IcpStep {
  std::size_t pairs = 0;
  double rms_residual_m = 0.0;
  /// The motion, in the frame map, by which the current scan is to move; nothing when the pairs
  /// leave it open.
  std::optional<Pose3> motion_map{};
  bool settled = true;  ///< False while the weights still change by themselves.
  /// Squared length of the motion over its covariance; infinite where no covariance is known.
  double motion_chi2 = std::numeric_limits<double>::infinity();
};

/// What is known of the pose when ICP ends.
struct IcpKnowledge {
  Matrix6d covariance;
  std::vector<Matrix6d> told_by_references;  ///< As in IcpResult.
};

/// Pairs, and the step they ask for, under one metric. Each object serves one registration.
class IcpMinimizer {
 public:
  IcpMinimizer() = default;
  IcpMinimizer(const IcpMinimizer&) = delete;
  IcpMinimizer& operator=(const IcpMinimizer&) = delete;
  virtual ~IcpMinimizer() = default;

  virtual IcpStep Iterate(const Pose3& T_map_cur, int iteration) = 0;
  /// What the pairs of the last iteration and the guess tell of the pose.
  virtual IcpKnowledge Knowledge() const = 0;
  virtual SearchStatistics statistics() const = 0;
};

/// Pairs of the current scan with each of several references, which stand still in the frame map.
///
/// `Pairs` knows one reference: `Collect(T_ref_cur, iteration)` returns sums over its pairs in the
/// frame ref; `sums.In(T_map_ref)` carries them over, `+=` adds them, and `Step(sums, ...)` is the
/// motion they ask for, `Told(sums, curvature, ...)` the information that all pairs are, of which
/// each reference has a share by their `Weight()`, and `ToldByGuess(...)` what the guess adds. With
/// one reference at the origin of map this is plain ICP.
template <class Pairs>
class JointMinimizer final : public IcpMinimizer {
 public:
  JointMinimizer(std::span<const IcpReference> references,
                 const ScanModel& cur,
                 const UncertainPose3& T_map_guess,
                 const IcpOptions& options)
      : options_(options), T_map_guess_(T_map_guess) {
    for (const IcpReference& reference : references) {
      pairs_.push_back({.T_map_ref = reference.T_map_ref,
                        .with_ref = std::make_unique<Pairs>(*reference.model, cur, options)});
    }
  }

  IcpStep Iterate(const Pose3& T_map_cur, int iteration) override {
    sums_ = {};
    for (const Member& member : pairs_) {
      const Pose3 T_ref_cur = member.T_map_ref.Inverse() * T_map_cur;
      sums_ += member.with_ref->Collect(T_ref_cur, iteration).In(member.T_map_ref);
    }
    return Pairs::Step(sums_, {.now = T_map_cur, .guess = T_map_guess_}, options_);
  }

  IcpKnowledge Knowledge() const override {
    Matrix6d curvature = Matrix6d::Zero();
    for (const Member& member : pairs_) {
      curvature += InMap(member, member.with_ref->Curvature());
    }
    const Matrix6d told = Pairs::Told(sums_, curvature, T_map_guess_);
    return {.covariance = InverseOf(told + Pairs::ToldByGuess(T_map_guess_)),
            .told_by_references = Shares(told)};
  }

  SearchStatistics statistics() const override {
    SearchStatistics total;
    for (const Member& member : pairs_) total += member.with_ref->statistics();
    return total;
  }

 private:
  struct Member {
    Pose3 T_map_ref;
    std::unique_ptr<Pairs> with_ref;
  };

  static Matrix6d InMap(const Member& member, const Matrix6d& information_ref) {
    const Matrix6d R_map_ref = BlockRotation(member.T_map_ref.rotation);
    return R_map_ref * information_ref * R_map_ref.transpose();
  }

  /// What all pairs tell, by references.
  std::vector<Matrix6d> Shares(const Matrix6d& told) const {
    if (pairs_.size() == 1) return {told};
    std::vector<Matrix6d> shares;
    Matrix6d sum = Matrix6d::Zero();
    for (const Member& member : pairs_) {
      shares.push_back(InMap(member, member.with_ref->Weight()));
      sum += shares.back();
    }
    const Matrix6d G = CongruenceOf(sum, told);
    for (Matrix6d& share : shares) share = G * share * G.transpose();
    return shares;
  }

  const IcpOptions options_;
  const UncertainPose3 T_map_guess_;
  std::vector<Member> pairs_;
  typename Pairs::Sums sums_;
};

}  // namespace slam6d
