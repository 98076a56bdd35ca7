// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "slam6d/cloud/reduction.hpp"
#include "slam6d/cloud/scan_model.hpp"
#include "slam6d/icp/icp.hpp"
#include "slam6d/mapping/graph_covariance.hpp"
#include "slam6d/mapping/loop_hypotheses.hpp"
#include "slam6d/mapping/model_refinement.hpp"
#include "slam6d/mapping/pose_graph.hpp"
#include "slam6d/mapping/scan_registration.hpp"

namespace slam6d {

struct SlamOptions {
  double min_range_m = 0.0;
  double max_range_m = 0.0;  ///< Points farther off are misses; 0: there are no misses.
  /// Thinning of the scans; where it names no size, `thin_above_points` decides.
  ReductionOptions reduction{};
  /// A scan with more points is thinned to cubes as large as its points lie apart where it sees
  /// far: points nearer to each other tell the same of the same surface, errors included; and to
  /// larger ones where only these are larger than the surfaces are thick. 0 keeps them all.
  int thin_above_points = 26'000;
  KdTreeOptions tree{};
  OverlapOptions guess{};
  IcpOptions icp{};
  EvidenceOptions evidence{};
  int references = 3;  ///< A scan is registered with so many scans before it at once.
  LoopOptions loop{};
  RefinementOptions refinement{};
};

template <class Visitor>
void Describe(Visitor& visit, SlamOptions& o) {
  visit("min_range_m", o.min_range_m, {.help = "nearer points are dropped", .min = 0, .max = 1e6});
  visit("max_range_m",
        o.max_range_m,
        {.help = "farther points are dropped; 0 keeps all", .min = 0, .max = 1e6});
  visit("reduction", o.reduction, {.help = "thinning of the scans by an octree"});
  visit("thin_above_points",
        o.thin_above_points,
        {.help = "without a voxel_m, scans with more points are thinned to the spacing that they "
                 "have far off; 0 keeps all",
         .min = 0,
         .max = 1e9});
  visit("tree", o.tree, {.help = "the kd-tree of a scan"});
  visit("guess", o.guess, {.help = "initial guess by overlapping octrees"});
  visit("icp", o.icp, {.help = "registration of two scans"});
  visit("evidence", o.evidence, {.help = "when a registration is believed"});
  visit("references",
        o.references,
        {.help = "scans before, with all of which a scan is registered at once",
         .min = 1,
         .max = 1000});
  visit("loop", o.loop, {.help = "closing of loops"});
  visit("refinement", o.refinement, {.help = "fit of all scans to each other at the end"});
}

/// Says how a scan got its pose.
enum class SlamStatus {
  kFirst,         ///< The scan is where the map begins.
  kMatched,       ///< The scan was registered with those before it.
  kDeadReckoned,  ///< The scan could not be registered; it is placed by odometry alone.
  /// The scan has too few points, or all the same: placed by odometry, and no reference for others.
  kUnusable,
};

/// The status in words for a person.
constexpr std::string_view Name(SlamStatus status) {
  switch (status) {
    case SlamStatus::kFirst:
      return "first";
    case SlamStatus::kMatched:
      return "matched";
    case SlamStatus::kDeadReckoned:
      return "dead-reckoned";
    case SlamStatus::kUnusable:
      return "unusable";
  }
  return "";
}

/// What became of one scan.
struct SlamStep {
  SlamStatus status = SlamStatus::kUnusable;
  Pose3 T_map_scan;
  /// Covariance of the pose as in UncertainPose3, with all error since the first scan but what
  /// loops have taken out.
  Matrix6d covariance = Matrix6d::Zero();
  double voxel_m = 0.0;    ///< Cubes by which the scan was thinned; 0 if it was not.
  std::size_t points = 0;  ///< Points of the scan after its reduction.
  IcpResult match{};       ///< Match with the scans before; its `ref` is the map.
  int open_motions = 0;    ///< Of six motions, so many the match leaves to the odometry.
  /// Share of the scan's points that lie on what the scans before saw, after the match.
  double overlap = 0.0;
  std::size_t told = 0;  ///< Points of which two scans both tell after the match.
  /// Share of the points told about by two scans that contradict the other: solid for one, air for
  /// the other.
  double contradiction = 0.0;
  std::vector<std::size_t> loops_to{};  ///< Earlier scans with which a loop was closed.
};

/// The pose of scan n + 1 from that of scan n and the odometry of both (Nüchter et al. 2007,
/// section 3.1): the change that odometry saw in the plane happens in the plane in which the robot
/// really stands.
Pose3 ExtrapolateOdometry(const Pose3& T_map_last,
                          const Pose3& T_odom_last,
                          const Pose3& T_odom_scan);

/// 6D SLAM (Nüchter et al. 2007, section 3): scans taken one after the other, in one consistent
/// model.
class Slam {
 public:
  /// Starts an empty map. @param closer outlives this.
  Slam(const SlamOptions& options, const LoopCloser& closer);

  /// Adds a scan. The poses of earlier ones change where it closes a loop.
  /// @param scan in the scanner's frame. @param T_odom_scan its pose by odometry, or any estimate.
  SlamStep Add(const PointCloud& scan, const Pose3& T_odom_scan);

  /// Fits all scans to each other, where the options want it.
  RefinementResult Refine(const RefinementObserver& observer = {});

  const std::vector<Pose3>& T_map_scan() const { return graph_.T_map_scan; }
  const PoseGraph& graph() const { return graph_; }
  const SlamOptions& options() const { return options_; }

 private:
  struct Entry {
    double range_m;  ///< How far the scanner sees.
    ScanModel model;
    RangeImage image;
  };

  PlacedScan Placed(std::size_t scan) const;
  Registration Register(std::span<const std::size_t> references,
                        const PlacedScan& cur,
                        const Matrix6d& guess_covariance,
                        const RegistrationOptions& options) const;
  std::vector<std::size_t> LastUsable(int count) const;
  SlamStatus Match(const PlacedScan& cur, const Matrix6d& guess_covariance, SlamStep& step) const;
  void Constrain(std::size_t from, const UncertainPose3& T_map_last);
  void ConstrainLast(const SlamStep& step, const Matrix6d& guess_covariance);
  std::vector<std::size_t> LastScans() const;
  void CloseLoops(SlamStep& step);

  SlamOptions options_;
  const LoopCloser& closer_;
  std::deque<std::optional<Entry>> entries_;  ///< Nothing for unusable scans.
  Pose3 T_odom_last_;
  PoseGraph graph_;
  std::vector<ErrorOrigin> origins_;  ///< Of the poses in the graph.
  JointCovariance recent_;            ///< Of the scans on which the next one will hang.
};

}  // namespace slam6d
