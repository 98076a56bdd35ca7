// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/graph_covariance.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>

#include "slam6d/src/algebra/decompositions.hpp"

namespace slam6d {
namespace {

constexpr Eigen::Index kDegrees = 6;  ///< Degrees of freedom of a pose.

/// What the error of one scan adds to that of another, in the frame map.
struct Term {
  std::size_t scan;
  Matrix6d J;
};

std::vector<Term> TermsOf(const ErrorOrigin& origin, std::span<const Pose3> T_map_scan) {
  const Pose3& pose = T_map_scan[origin.scan];
  const Matrix6d R = BlockRotation(pose.rotation);
  std::vector<Term> terms;
  for (const ErrorOrigin::Share& share : origin.shares) {
    Matrix6d by_turn = Matrix6d::Identity();  // A turn of one scan moves the other on a lever.
    by_turn.topRightCorner<3, 3>() = -Skew(pose.translation_m - T_map_scan[share.of].translation_m);
    terms.push_back({share.of, R * share.weight * R.transpose() * by_turn});
  }
  return terms;
}

/// Of the error of its own, in the frame map.
Matrix6d OwnCovariance(const ErrorOrigin& origin, std::span<const Pose3> T_map_scan) {
  const Matrix6d R = BlockRotation(T_map_scan[origin.scan].rotation);
  return R * origin.covariance * R.transpose();
}

/// The normal equations of poses, but for the first scan of all, which stands still.
class PoseInformation {
 public:
  /// @param scans in rising order.
  explicit PoseInformation(std::vector<std::size_t> scans) : scans_(std::move(scans)) {}

  void Add(const ErrorOrigin& origin, std::span<const Pose3> T_map_scan) {
    const Matrix6d information = InverseOf(OwnCovariance(origin, T_map_scan));
    std::vector<Term> terms = TermsOf(origin, T_map_scan);
    terms.push_back({origin.scan, -Matrix6d::Identity()});
    for (const Term& a : terms) {
      for (const Term& b : terms) {
        AddBlock(a.scan, b.scan, a.J.transpose() * information * b.J);
      }
    }
  }

  /// The joint covariance of some of the scans.
  Eigen::MatrixXd CovarianceOf(std::span<const std::size_t> scans) const {
    const Eigen::Index rows = kDegrees * std::ssize(scans_);
    const Eigen::Index kept = kDegrees * std::ssize(scans);
    Eigen::SparseMatrix<double> information(rows, rows);
    information.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(information);
    Eigen::MatrixXd chosen = Eigen::MatrixXd::Zero(rows, kept);
    for (Eigen::Index i = 0; i < kept; ++i) {
      chosen(RowOf(scans[static_cast<std::size_t>(i / kDegrees)]) + i % kDegrees, i) = 1.0;
    }
    return chosen.transpose() * factors.solve(chosen);
  }

 private:
  /// The first row of a scan.
  Eigen::Index RowOf(std::size_t scan) const {
    const auto place = std::ranges::lower_bound(scans_, scan);
    assert(place != scans_.end() && *place == scan && "the scan has a row");
    return kDegrees * (place - scans_.begin());
  }

  void AddBlock(std::size_t scan, std::size_t other, const Matrix6d& block) {
    if (scan == 0 || other == 0) return;
    const Eigen::Index row = RowOf(scan);
    const Eigen::Index column = RowOf(other);
    for (Eigen::Index i = 0; i < kDegrees; ++i) {
      for (Eigen::Index j = 0; j < kDegrees; ++j) {
        entries_.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j), block(i, j));
      }
    }
  }

  std::vector<std::size_t> scans_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Puts scans into rising order, each once, without the first of all.
void SortWithoutFirst(std::vector<std::size_t>& scans) {
  std::ranges::sort(scans);
  scans.erase(std::unique(scans.begin(), scans.end()), scans.end());
  if (!scans.empty() && scans.front() == 0) scans.erase(scans.begin());
}

/// The first row of a scan among several.
Eigen::Index RowAmong(std::span<const std::size_t> scans, std::size_t scan) {
  const auto place = std::ranges::find(scans, scan);
  assert(place != scans.end() && "the scan is one of these");
  return kDegrees * (place - scans.begin());
}

}  // namespace

Matrix6d JointCovariance::Of(std::size_t scan) const {
  if (scan == 0) return Matrix6d::Zero();
  const Eigen::Index row = RowAmong(scans, scan);
  return covariance.block<kDegrees, kDegrees>(row, row);
}

JointCovariance CovarianceBy(std::span<const ErrorOrigin> origins,
                             std::span<const Pose3> T_map_scan,
                             std::vector<std::size_t> scans) {
  std::vector<std::size_t> all;
  for (const ErrorOrigin& origin : origins) all.push_back(origin.scan);
  SortWithoutFirst(all);
  PoseInformation information(std::move(all));
  for (const ErrorOrigin& origin : origins) information.Add(origin, T_map_scan);
  SortWithoutFirst(scans);
  JointCovariance joint{.scans = std::move(scans), .covariance = {}};
  joint.covariance = information.CovarianceOf(joint.scans);
  return joint;
}

JointCovariance WithNext(const JointCovariance& known,
                         const ErrorOrigin& origin,
                         std::span<const Pose3> T_map_scan) {
  const Eigen::Index rows = known.covariance.rows();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kDegrees, rows);
  for (const Term& term : TermsOf(origin, T_map_scan)) {
    if (term.scan == 0) continue;
    J.middleCols<kDegrees>(RowAmong(known.scans, term.scan)) += term.J;
  }
  const Eigen::MatrixXd shared = J * known.covariance;
  JointCovariance joint{.scans = known.scans, .covariance{rows + kDegrees, rows + kDegrees}};
  joint.scans.push_back(origin.scan);
  joint.covariance.topLeftCorner(rows, rows) = known.covariance;
  joint.covariance.bottomLeftCorner(kDegrees, rows) = shared;
  joint.covariance.topRightCorner(rows, kDegrees) = shared.transpose();
  joint.covariance.bottomRightCorner<kDegrees, kDegrees>() =
      shared * J.transpose() + OwnCovariance(origin, T_map_scan);
  return joint;
}

JointCovariance Kept(const JointCovariance& known, std::vector<std::size_t> scans) {
  SortWithoutFirst(scans);
  const Eigen::Index rows = kDegrees * std::ssize(scans);
  JointCovariance kept{.scans = std::move(scans), .covariance{rows, rows}};
  for (Eigen::Index i = 0; i < rows; i += kDegrees) {
    for (Eigen::Index j = 0; j < rows; j += kDegrees) {
      kept.covariance.block<kDegrees, kDegrees>(i, j) = known.covariance.block<kDegrees, kDegrees>(
          RowAmong(known.scans, kept.scans[static_cast<std::size_t>(i / kDegrees)]),
          RowAmong(known.scans, kept.scans[static_cast<std::size_t>(j / kDegrees)]));
    }
  }
  return kept;
}

}  // namespace slam6d
