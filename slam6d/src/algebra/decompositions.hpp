// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

// Eigen's decompositions of small matrices, compiled once for the library: a source that calls them
// itself takes ten seconds longer to compile each.

/// The unit eigenvector of the largest eigenvalue of a symmetric matrix.
Eigen::Vector4d DominantEigenvector(const Eigen::Matrix4d& symmetric);

/// The eigenvalues of a symmetric matrix, rising.
Vector6d EigenvaluesOf(const Matrix6d& symmetric);

/// The solutions of A v = value B v.
struct GeneralizedEigen6 {
  Vector6d values;   ///< Eigenvalues, rising.
  Matrix6d vectors;  ///< One per column, with v^T B v = 1.
};
/// Solves A v = value B v. @param A symmetric. @param B symmetric and positive definite.
GeneralizedEigen6 GeneralizedEigenOf(const Matrix6d& A, const Matrix6d& B);

/// The solution x of A x = b. @param A symmetric and positive definite.
Vector6d SolvePositive(const Matrix6d& A, const Vector6d& b);

Matrix6d InverseOf(const Matrix6d& A);

/// A matrix G with G A G^T = B, for positive definite A and a B that is not negative.
Matrix6d CongruenceOf(const Matrix6d& A, const Matrix6d& B);

}  // namespace slam6d
