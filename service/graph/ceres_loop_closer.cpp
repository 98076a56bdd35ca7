// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/graph/ceres_loop_closer.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace slam6d::graph {
namespace {

/// Residuals of so many standard deviations begin to lose weight. Registrations promise more than
/// they hold, so this is wide.
constexpr double kHuberSigmas = 10.0;

struct Variables {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d translation_m;
};

/// The error of one constraint: translation and rotation along the axes of `from`.
class RelativePoseCost {
 public:
  explicit RelativePoseCost(const PoseConstraint& constraint)
      : rotation_(constraint.T_from_to.rotation),
        translation_m_(constraint.T_from_to.translation_m) {
    const Matrix6d information = constraint.covariance.inverse();
    root_information_ = information.llt().matrixU();
  }

  template <class Scalar>
  bool operator()(const Scalar* rotation_from,
                  const Scalar* translation_from,
                  const Scalar* rotation_to,
                  const Scalar* translation_to,
                  Scalar* residuals) const {
    using Quaternion = Eigen::Quaternion<Scalar>;
    using Vector3 = Eigen::Matrix<Scalar, 3, 1>;
    const Eigen::Map<const Quaternion> q_from(rotation_from);
    const Eigen::Map<const Quaternion> q_to(rotation_to);
    const Eigen::Map<const Vector3> t_from(translation_from);
    const Eigen::Map<const Vector3> t_to(translation_to);

    const Quaternion q_error =
        q_from.conjugate() * q_to * rotation_.template cast<Scalar>().conjugate();
    Eigen::Map<Eigen::Matrix<Scalar, 6, 1>> error(residuals);
    error.template head<3>() =
        q_from.conjugate() * (t_to - t_from) - translation_m_.template cast<Scalar>();
    error.template tail<3>() = Scalar(2.0) * q_error.vec();
    error.applyOnTheLeft(root_information_.template cast<Scalar>());
    return true;
  }

 private:
  Eigen::Quaterniond rotation_;
  Eigen::Vector3d translation_m_;
  Matrix6d root_information_;
};

using AutoDiffCost = ceres::AutoDiffCostFunction<RelativePoseCost, 6, 4, 3, 4, 3>;

std::vector<Variables> VariablesOf(const std::vector<Pose3>& poses) {
  std::vector<Variables> variables;
  for (const Pose3& pose : poses) {
    variables.push_back({Eigen::Quaterniond(pose.rotation), pose.translation_m});
  }
  return variables;
}

void AddConstraint(const PoseConstraint& constraint,
                   std::vector<Variables>& poses,
                   ceres::Problem& problem) {
  Variables& from = poses[constraint.from];
  Variables& to = poses[constraint.to];
  problem.AddResidualBlock(new AutoDiffCost(new RelativePoseCost(constraint)),
                           new ceres::HuberLoss(kHuberSigmas),
                           from.rotation.coeffs().data(),
                           from.translation_m.data(),
                           to.rotation.coeffs().data(),
                           to.translation_m.data());
}

void Solve(ceres::Problem& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}

}  // namespace

std::vector<Pose3> CeresLoopCloser::Close(const PoseGraph& graph) const {
  std::vector<Variables> poses = VariablesOf(graph.T_map_scan);
  ceres::Problem problem;
  for (Variables& pose : poses) {
    problem.AddParameterBlock(pose.rotation.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
    problem.AddParameterBlock(pose.translation_m.data(), 3);
  }
  for (const PoseConstraint& constraint : graph.constraints) {
    AddConstraint(constraint, poses, problem);
  }
  problem.SetParameterBlockConstant(poses.front().rotation.coeffs().data());
  problem.SetParameterBlockConstant(poses.front().translation_m.data());
  Solve(problem);

  std::vector<Pose3> result;
  for (const Variables& pose : poses) {
    result.push_back({.rotation = pose.rotation.normalized().toRotationMatrix(),
                      .translation_m = pose.translation_m});
  }
  return result;
}

}  // namespace slam6d::graph
