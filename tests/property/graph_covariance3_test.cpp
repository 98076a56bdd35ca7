// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "slam6d/mapping/graph_covariance.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

constexpr double kOwnSigma = 0.01;
constexpr std::size_t kScans = 12;

/// Poses on an arc; each errs by the mean of the three before it, and by something of its own.
struct Arc {
  std::vector<Pose3> T_map_scan;
  std::vector<ErrorOrigin> origins;
};

Arc MakeArc() {
  Arc arc;
  for (std::size_t scan = 0; scan < kScans; ++scan) {
    const double angle_rad = 0.2 * static_cast<double>(scan);
    arc.T_map_scan.push_back(
        {.rotation = RotationFromRollPitchYaw({0.05, 0.1, angle_rad}),
         .translation_m = {5.0 * std::cos(angle_rad), 5.0 * std::sin(angle_rad), 0.3 * angle_rad}});
    if (scan == 0) continue;
    ErrorOrigin origin{
        .scan = scan, .shares = {}, .covariance = kOwnSigma * kOwnSigma * Matrix6d::Identity()};
    const std::size_t references = std::min<std::size_t>(scan, 3);
    for (std::size_t back = 1; back <= references; ++back) {
      const double share = 1.0 / static_cast<double>(references);
      origin.shares.push_back({.of = scan - back, .weight = share * Matrix6d::Identity()});
    }
    arc.origins.push_back(origin);
  }
  return arc;
}

JointCovariance OfLast(const Arc& arc) {
  return CovarianceBy(arc.origins, arc.T_map_scan, {kScans - 1});
}

// What a scan has from three others is a mean of their errors: a chain of such scans errs half as
// much as one in which each hangs on the last alone.
TEST(GraphCovariance, PredictsTheErrorOfScansThatHangOnThree) {
  constexpr int kDraws = 4000;
  const Arc arc = MakeArc();
  std::mt19937 random(5);
  Matrix6d drawn = Matrix6d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Vector6d> errors(kScans, Vector6d::Zero());
    for (const ErrorOrigin& origin : arc.origins) {
      Vector6d& error = errors[origin.scan];
      error << DrawNormal(random, kOwnSigma), DrawNormal(random, kOwnSigma);
      for (const ErrorOrigin::Share& share : origin.shares) {
        Vector6d moved = errors[share.of];  // A turn moves what stands on its lever.
        moved.head<3>() += moved.tail<3>().cross(arc.T_map_scan[origin.scan].translation_m -
                                                 arc.T_map_scan[share.of].translation_m);
        error += share.weight * moved;
      }
    }
    drawn += errors.back() * errors.back().transpose() / kDraws;
  }
  const Matrix6d told = OfLast(arc).Of(kScans - 1);
  EXPECT_LT((told - drawn).norm(), 0.06 * drawn.norm());
}

TEST(GraphCovariance, TellsTheSameScanByScanAsOfTheWholeGraph) {
  const Arc arc = MakeArc();
  JointCovariance recent;
  for (const ErrorOrigin& origin : arc.origins) {
    std::vector<std::size_t> kept{origin.scan};
    for (std::size_t back = 1; back <= std::min<std::size_t>(origin.scan, 3); ++back) {
      kept.push_back(origin.scan - back);
    }
    recent = Kept(WithNext(recent, origin, arc.T_map_scan), kept);
  }
  EXPECT_TRUE(recent.Of(kScans - 1).isApprox(OfLast(arc).Of(kScans - 1), 1e-9));
  EXPECT_TRUE(recent.Of(0).isZero());
}

TEST(GraphCovariance, IsSmallerOnceALoopIsClosed) {
  Arc arc = MakeArc();
  const Matrix6d open = OfLast(arc).Of(kScans - 1);
  const Matrix6d own = kOwnSigma * kOwnSigma * Matrix6d::Identity();
  arc.origins.push_back({.scan = kScans - 1, .shares = {{.of = 0}}, .covariance = own});
  const Matrix6d closed = OfLast(arc).Of(kScans - 1);
  EXPECT_TRUE(closed.inverse().isApprox(open.inverse() + own.inverse(), 1e-9));
}

}  // namespace
}  // namespace slam6d
