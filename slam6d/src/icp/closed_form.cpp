// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/icp/closed_form.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "slam6d/src/algebra/decompositions.hpp"
#include "slam6d/src/algebra/svd.hpp"

namespace slam6d {
namespace {

/// Below this share of the largest singular value the second one is rounding: a line of points.
constexpr double kLineShare = 1e-12;

/// Arun et al. (1987) as in Nüchter et al. (2007), section 3.3: H = U Lambda V^T, R = V U^T. The
/// factor in the middle keeps a reflection out, which noise can make the better fit for points near
/// a plane.
Eigen::Matrix3d RotationBySvd(const Eigen::Matrix3d& H) {
  const Svd3 svd = SvdOf(H);
  const double handedness = (svd.V * svd.U.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.V * Eigen::Vector3d(1.0, 1.0, handedness).asDiagonal() * svd.U.transpose();
}

/// Horn (1987), section 4.A: the matrix N whose eigenvector of the largest eigenvalue is the unit
/// quaternion (w, x, y, z) of the rotation. S = sum d' m'^T.
Eigen::Matrix4d HornMatrix(const Eigen::Matrix3d& S) {
  Eigen::Matrix4d N;
  const Eigen::Vector3d axial(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  N(0, 0) = S.trace();
  N.block<1, 3>(0, 1) = axial.transpose();
  N.block<3, 1>(1, 0) = axial;
  N.block<3, 3>(1, 1) = S + S.transpose() - S.trace() * Eigen::Matrix3d::Identity();
  return N;
}

Eigen::Matrix3d RotationByUnitQuaternion(const Eigen::Matrix3d& H) {
  const Eigen::Vector4d q = DominantEigenvector(HornMatrix(H));
  return Eigen::Quaterniond(q(0), q(1), q(2), q(3)).normalized().toRotationMatrix();
}

/// Horn et al. (1988), section 4: R = M (M^T M)^(-1/2) with M = sum m' d'^T, from the eigenvectors
/// u_k of M^T M: u_k turns into M u_k / sqrt(lambda_k). The direction of the smallest eigenvalue,
/// which is 0 for points in a plane, follows from the other two, so that no reflection is possible.
Eigen::Matrix3d RotationByOrthonormalMatrices(const Eigen::Matrix3d& H) {
  const Eigen::Matrix3d M = H.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(M.transpose() * M);
  const Eigen::Vector3d u1 = eigen.eigenvectors().col(2);
  const Eigen::Vector3d u2 = eigen.eigenvectors().col(1);
  const Eigen::Vector3d v1 = (M * u1).normalized();
  const Eigen::Vector3d Mu2 = M * u2;
  const Eigen::Vector3d v2 = (Mu2 - v1 * v1.dot(Mu2)).normalized();
  return v1 * u1.transpose() + v2 * u2.transpose() + v1.cross(v2) * u1.cross(u2).transpose();
}

/// Quaternions (x, y, z, w) as Walker et al. write them: Q(a) b = a b and W(b) a = a b.
Eigen::Matrix4d LeftProduct(const Eigen::Vector4d& a) {
  Eigen::Matrix4d Q = a(3) * Eigen::Matrix4d::Identity();
  Q.topLeftCorner<3, 3>() += Skew(a.head<3>());
  Q.topRightCorner<3, 1>() += a.head<3>();
  Q.bottomLeftCorner<1, 3>() -= a.head<3>().transpose();
  return Q;
}

Eigen::Matrix4d RightProduct(const Eigen::Vector4d& b) {
  Eigen::Matrix4d W = b(3) * Eigen::Matrix4d::Identity();
  W.topLeftCorner<3, 3>() -= Skew(b.head<3>());
  W.topRightCorner<3, 1>() += b.head<3>();
  W.bottomLeftCorner<1, 3>() -= b.head<3>().transpose();
  return W;
}

/// A point as Walker et al. write it: half of it is the vector part of a quaternion.
Eigen::Vector4d HalfPoint(const Eigen::Vector3d& point) {
  return {0.5 * point.x(), 0.5 * point.y(), 0.5 * point.z(), 0.0};
}

/// sum Q(m_i)^T W(d_i), which is linear in the products of the coordinates, from H and centroids.
Eigen::Matrix4d SumOfProducts(const PairMoments& moments) {
  const Eigen::Matrix3d sum_m_d = moments.H_m2.transpose() + moments.count * moments.center_ref_m *
                                                                 moments.center_cur_m.transpose();
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Eigen::Matrix4d Q = LeftProduct(HalfPoint(Eigen::Vector3d::Unit(i)));
      const Eigen::Matrix4d W = RightProduct(HalfPoint(Eigen::Vector3d::Unit(j)));
      sum += sum_m_d(i, j) * Q.transpose() * W;
    }
  }
  return sum;
}

/// Walker, Shao & Volz (1991), Eqs. 32-35 and 37-43, all weights 1 and no directions: rotation and
/// translation together as the dual quaternion (r, s).
Pose3 AlignByDualQuaternion(const PairMoments& moments) {
  const Eigen::Matrix4d C1 = -2.0 * SumOfProducts(moments);
  const double c2 = moments.count;  // C2 = c2 I
  const Eigen::Matrix4d C3 = 2.0 * moments.count *
                             (RightProduct(HalfPoint(moments.center_cur_m)) -
                              LeftProduct(HalfPoint(moments.center_ref_m)));
  const Eigen::Matrix4d A = 0.5 * (C3.transpose() * C3 / (2.0 * c2) - C1 - C1.transpose());
  const Eigen::Vector4d r = DominantEigenvector(A);
  const Eigen::Vector4d s = -C3 * r / (2.0 * c2);
  return {.rotation = Eigen::Quaterniond(r(3), r(0), r(1), r(2)).normalized().toRotationMatrix(),
          .translation_m = 2.0 * (RightProduct(r).transpose() * s).head<3>()};
}

bool LeavesRotationOpen(const PairMoments& moments) {
  if (moments.count < 3.0 || !moments.H_m2.allFinite()) return true;
  const Eigen::Vector3d singular = SvdOf(moments.H_m2).values;
  return !(singular(1) > kLineShare * singular(0));
}

}  // namespace

std::optional<Pose3> AlignPairs(const PairMoments& moments, ClosedForm form) {
  if (LeavesRotationOpen(moments)) return std::nullopt;
  Pose3 motion;
  switch (form) {
    case ClosedForm::kSvd:
      motion.rotation = RotationBySvd(moments.H_m2);
      break;
    case ClosedForm::kUnitQuaternion:
      motion.rotation = RotationByUnitQuaternion(moments.H_m2);
      break;
    case ClosedForm::kOrthonormal:
      motion.rotation = RotationByOrthonormalMatrices(moments.H_m2);
      break;
    case ClosedForm::kDualQuaternion:
      return AlignByDualQuaternion(moments);
  }
  // Nüchter et al. (2007), Eq. 5: t = c_m - R c_d.
  motion.translation_m = moments.center_ref_m - motion.rotation * moments.center_cur_m;
  return motion;
}

}  // namespace slam6d
