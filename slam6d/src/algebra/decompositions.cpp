// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/src/algebra/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace slam6d {
namespace {

/// One type for all sizes, so that Eigen's templates are compiled once for all of them.
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

}  // namespace

Eigen::Vector4d DominantEigenvector(const Eigen::Matrix4d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Small>(symmetric).eigenvectors().col(3);
}

Vector6d EigenvaluesOf(const Matrix6d& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Small>(symmetric).eigenvalues();
}

GeneralizedEigen6 GeneralizedEigenOf(const Matrix6d& A, const Matrix6d& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Small> eigen(A, B);
  return {.values = eigen.eigenvalues(), .vectors = eigen.eigenvectors()};
}

Vector6d SolvePositive(const Matrix6d& A, const Vector6d& b) { return A.ldlt().solve(b); }

Matrix6d InverseOf(const Matrix6d& A) { return A.inverse(); }

Matrix6d CongruenceOf(const Matrix6d& A, const Matrix6d& B) {
  const Eigen::SelfAdjointEigenSolver<Small> eigen(B);
  const Vector6d roots = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Matrix6d root_of_A = A.llt().matrixL();
  return eigen.eigenvectors() * roots.asDiagonal() * root_of_A.inverse();
}

}  // namespace slam6d
