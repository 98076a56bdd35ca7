// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/model_refinement.hpp"

#include <algorithm>
#include <deque>

namespace slam6d {
namespace {

/// Iterations of one fit, at most: a scan that still moves comes to its turn again.
constexpr int kMostIterations = 20;

/// A fit ends at steps of this share of what lets the neighbours rest: they move meanwhile, and the
/// last tenth of a millimetre of points that slide along surfaces takes most of the iterations.
constexpr double kStepShare = 0.3;

/// The queue of scans to be fitted, each in it once.
class FitQueue {
 public:
  FitQueue(std::size_t scans, int max_visits)
      : is_waiting_(scans), visits_left_(scans, max_visits) {}

  void Add(std::size_t scan) {
    if (scan == 0 || is_waiting_[scan]) return;
    if (visits_left_[scan] == 0) {
      refused_ = true;
      return;
    }
    is_waiting_[scan] = true;
    queue_.push_back(scan);
  }

  std::size_t Pop() {
    const std::size_t scan = queue_.front();
    queue_.pop_front();
    is_waiting_[scan] = false;
    --visits_left_[scan];
    return scan;
  }

  std::size_t size() const { return queue_.size(); }
  /// Whether a scan was to be fitted once more than it may.
  bool refused() const { return refused_; }

 private:
  std::deque<std::size_t> queue_;
  std::vector<bool> is_waiting_;
  std::vector<int> visits_left_;
  bool refused_ = false;
};

bool Moved(const Pose3& before, const Pose3& after, const RefinementOptions& options) {
  return (after.translation_m - before.translation_m).norm() > options.translation_tolerance_m ||
         RotationAngle(before.rotation.transpose() * after.rotation) >
             options.rotation_tolerance_rad;
}

/// How far the points of a scan are from the scanner, at most.
double ReachM(const ScanModel& model) {
  const Box& limits = model.tree.layout().limits[0];
  const Eigen::Vector3d low_m = Eigen::Vector3d(limits.low_m).cwiseAbs();
  return low_m.cwiseMax(Eigen::Vector3d(limits.high_m).cwiseAbs()).norm();
}

/// The nearest of the scans that overlap with one of them.
std::vector<std::size_t> Neighbors(std::span<const IcpReference> scans,
                                   std::size_t current,
                                   const RefinementOptions& options) {
  const IcpReference& cur = scans[current];
  const double reach_m = ReachM(*cur.model) + options.max_distance_m;
  const auto distance_m = [&](std::size_t scan) {
    return (scans[scan].T_map_ref.translation_m - cur.T_map_ref.translation_m).norm();
  };
  std::vector<std::size_t> by_distance;
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    if (scan == current || scans[scan].model == nullptr) continue;
    // So that the time of a fit does not grow with the model.
    if (distance_m(scan) > reach_m + ReachM(*scans[scan].model)) continue;
    by_distance.push_back(scan);
  }
  std::ranges::stable_sort(by_distance, {}, distance_m);
  std::vector<std::size_t> neighbors;
  for (const std::size_t scan : by_distance) {
    if (neighbors.size() == static_cast<std::size_t>(options.max_neighbors)) break;
    const IcpReference& ref = scans[scan];
    const Pose3 T_ref_cur = ref.T_map_ref.Inverse() * cur.T_map_ref;
    if (OverlapsByPairs(*ref.model, *cur.model, T_ref_cur, options)) {
      neighbors.push_back(scan);
    }
  }
  return neighbors;
}

/// Where the scan fits best among its neighbours; where it is, if that cannot be found.
Pose3 Fit(std::span<const IcpReference> scans,
          std::size_t current,
          std::span<const std::size_t> neighbors,
          const IcpOptions& icp) {
  std::vector<IcpReference> M;
  for (const std::size_t scan : neighbors) M.push_back(scans[scan]);
  const auto& [D, T_map_cur] = scans[current];
  const IcpResult result = Align(M, *D, T_map_cur, icp);
  const bool found =
      result.status == IcpStatus::kConverged || result.status == IcpStatus::kIterationLimit;
  return found ? result.T_ref_cur : T_map_cur;
}

std::vector<Pose3> PosesOf(std::span<const IcpReference> scans) {
  std::vector<Pose3> poses;
  for (const IcpReference& scan : scans) poses.push_back(scan.T_map_ref);
  return poses;
}

}  // namespace

bool OverlapsByPairs(const ScanModel& ref,
                     const ScanModel& cur,
                     const Pose3& T_ref_cur,
                     const RefinementOptions& options) {
  // Points near each other stand near each other: large strides soon see all of the scan.
  constexpr std::size_t kStrides = 64;
  int pairs = 0;
  for (std::size_t first = 0; first < kStrides; ++first) {
    for (std::size_t i = first; i < cur.points.size(); i += kStrides) {
      if (!ref.tree.FindNearest(T_ref_cur * cur.points[i], options.max_distance_m)) continue;
      if (++pairs > options.min_pairs) return true;
    }
  }
  return false;
}

RefinementResult RefineModel(std::span<const IcpReference> scans,
                             const IcpOptions& icp,
                             const RefinementOptions& options,
                             const RefinementObserver& observer) {
  IcpOptions fit = icp;
  fit.max_distance_m = options.max_distance_m;
  fit.max_iterations = std::min(fit.max_iterations, kMostIterations);
  fit.translation_tolerance_m =
      std::max(fit.translation_tolerance_m, kStepShare * options.translation_tolerance_m);
  fit.rotation_tolerance_rad =
      std::max(fit.rotation_tolerance_rad, kStepShare * options.rotation_tolerance_rad);
  std::vector<IcpReference> model(scans.begin(), scans.end());
  FitQueue queue(scans.size(), options.max_visits);
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    if (scans[scan].model != nullptr) queue.Add(scan);
  }
  RefinementResult result{.T_map_scan = {}};
  // Nüchter et al. (2007), section 3.5, steps 1 to 3.
  while (queue.size() > 0) {
    const std::size_t current = queue.Pop();                                        // 1.
    const std::vector<std::size_t> neighbors = Neighbors(model, current, options);  // 2.
    Pose3& T_map_cur = model[current].T_map_ref;
    const Pose3 before = T_map_cur;
    if (!neighbors.empty()) T_map_cur = Fit(model, current, neighbors, fit);
    if (Moved(before, T_map_cur, options)) {  // 3.
      for (const std::size_t neighbor : neighbors) queue.Add(neighbor);
    }
    ++result.fits;
    if (observer && !observer({.fits = result.fits, .waiting = queue.size()})) break;
  }
  result.settled = queue.size() == 0 && !queue.refused();
  result.T_map_scan = PosesOf(model);
  return result;
}

}  // namespace slam6d
