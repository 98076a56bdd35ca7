// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Whole registrations, trees and surfels included, against plain ICP on nanoflann in the same run.
#include <cstdio>
#include <numbers>
#include <vector>

#include "tests/bench/scan_pairs.hpp"

namespace slam6d::bench {
namespace {

struct Outcome {
  Pose3 T_ref_cur;
  int iterations = 0;
  double ms = 0.0;
};

/// Moments as Nüchter et al. (2007) write them: centroids first (Eq. 3), then the centred points
/// (Eqs. 4 and 6).
PairMoments MomentsOf(const std::vector<Eigen::Vector3d>& ref,
                      const std::vector<Eigen::Vector3d>& cur) {
  PairMoments moments{.count = static_cast<double>(ref.size())};
  for (std::size_t i = 0; i < ref.size(); ++i) {
    moments.center_ref_m += ref[i];
    moments.center_cur_m += cur[i];
  }
  moments.center_ref_m /= moments.count;
  moments.center_cur_m /= moments.count;
  for (std::size_t i = 0; i < ref.size(); ++i) {
    moments.H_m2 += (cur[i] - moments.center_cur_m) * (ref[i] - moments.center_ref_m).transpose();
  }
  return moments;
}

/// The yardstick: textbook ICP, points in the order of the file, stopping by the same rule.
Outcome AlignOnNanoflann(const ScanPair& pair, const IcpOptions& options) {
  Outcome outcome{.T_ref_cur = pair.T_ref_cur_guess};
  outcome.ms = Milliseconds([&] {
    const NanoflannTree tree(pair.ref);
    std::vector<Eigen::Vector3d> ref;
    std::vector<Eigen::Vector3d> cur;
    for (outcome.iterations = 1; outcome.iterations <= options.max_iterations;
         ++outcome.iterations) {
      ref.clear();
      cur.clear();
      for (std::size_t i = 0; i < pair.cur.size(); ++i) {
        const Eigen::Vector3d p_ref = outcome.T_ref_cur * pair.cur[i];
        const NanoflannTree::Found found = tree.FindNearest(p_ref);
        if (found.distance2_m2 >= options.max_distance_m * options.max_distance_m) continue;
        ref.push_back(pair.ref[found.index]);
        cur.push_back(p_ref);
      }
      const Pose3 motion = AlignPairs(MomentsOf(ref, cur), options.closed_form).value();
      const Pose3 before = outcome.T_ref_cur;
      outcome.T_ref_cur = motion * before;
      if ((outcome.T_ref_cur.translation_m - before.translation_m).norm() <
              options.translation_tolerance_m &&
          RotationAngle(motion.rotation) < options.rotation_tolerance_rad) {
        break;
      }
    }
  });
  return outcome;
}

Outcome AlignOurs(const ScanPair& pair, const KdTreeOptions& tree, const IcpOptions& options) {
  Outcome outcome;
  outcome.ms = Milliseconds([&] {
    const ScanModel ref(pair.ref, tree);
    const ScanModel cur(pair.cur, tree);
    const IcpResult result = Align(ref, cur, pair.T_ref_cur_guess, options);
    outcome.T_ref_cur = result.T_ref_cur;
    outcome.iterations = result.iterations;
  });
  return outcome;
}

void Print(const ScanPair& pair, const char* method, const Outcome& outcome, const Outcome& base) {
  std::printf("%-9s %-26s %10d %9.1f %6.2f",
              pair.name.c_str(),
              method,
              outcome.iterations,
              outcome.ms,
              base.ms / outcome.ms);
  if (pair.T_ref_cur_truth) {
    const Pose3 error = pair.T_ref_cur_truth->Inverse() * outcome.T_ref_cur;
    std::printf(" %9.4f %9.4f",
                100.0 * error.translation_m.norm(),
                RotationAngle(error.rotation) * 180.0 / std::numbers::pi);
  } else {
    std::printf(" %9s %9s", "-", "-");
  }
  const Pose3 difference = base.T_ref_cur.Inverse() * outcome.T_ref_cur;
  std::printf(
      " %10.1e %10.1e\n", difference.translation_m.norm(), RotationAngle(difference.rotation));
}

void Compare(const ScanPair& pair, const KdTreeOptions& tree) {
  IcpOptions options{.metric = IcpMetric::kPointToPoint};
  const Outcome base = AlignOnNanoflann(pair, options);
  Print(pair, "point-to-point, nanoflann", base, base);
  Print(pair, "point-to-point", AlignOurs(pair, tree, options), base);
  options.metric = IcpMetric::kPointToPlane;
  Print(pair, "point-to-plane", AlignOurs(pair, tree, options), base);
  options.metric = IcpMetric::kPlaneToPlane;
  Print(pair, "plane-to-plane", AlignOurs(pair, tree, options), base);
}

}  // namespace
}  // namespace slam6d::bench

int main(int argc, char** argv) {
  const std::vector<slam6d::bench::ScanPair> pairs = slam6d::bench::ReadPairs(argc, argv);
  const slam6d::KdTreeOptions tree = slam6d::bench::ReadTreeOptions(argc, argv);
  std::puts("registration with trees and surfels, CPU ms, one thread; ratio = nanoflann / method;");
  std::puts("error against the truth, then difference from the first line of the pair");
  std::puts(
      "                                     iterations        ms  ratio  error cm       deg "
      "    diff m        rad");
  for (const slam6d::bench::ScanPair& pair : pairs) slam6d::bench::Compare(pair, tree);
  return pairs.empty() ? 1 : 0;
}
