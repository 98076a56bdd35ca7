// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scan_chain.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "submap_match.hpp"

namespace qwsm {
namespace {

constexpr NodeId kSubmapScans = 16;
constexpr NodeId kSubmapStep = kSubmapScans / 2;
// Submaps serve scans that are like those in them: few points tell as much as many.
constexpr int kSubmapDensityPoints = 2;
// Odometry between two relevant scans is never better than this.
constexpr double kLeastSigma_m = 0.01;
constexpr double kLeastSigma_rad = 0.003;
// What a slip of the wheels, or a push, may have done where a scan does not fit.
constexpr double kSlipSigma_m = 0.4;
constexpr double kSlipSigma_rad = 0.15;
constexpr double kMinOverlapWithLast = 0.5;
// How far the answers may be off as a first guess.
constexpr StartError kStartError{.translation_m = 0.1, .rotation_rad = 0.02};

bool IsFound(const MatchResult& match) {
  return match.status == MatchStatus::kConverged || match.status == MatchStatus::kIterationLimit;
}

UncertainPose2 AtLeast(const UncertainPose2& pose, double sigma_m, double sigma_rad) {
  UncertainPose2 wider = pose;
  wider.covariance += UncertainPose2::WithSigmas({}, sigma_m, sigma_rad).covariance;
  return wider;
}

// The edge to a pose that was found in the frame of another: its covariance is along that frame's
// axes, the edge's along those of `from`.
PoseEdge EdgeTo(NodeId to, const Pose2& T_chain_from, const UncertainPose2& chain_to) {
  const UncertainPose2 from_chain{.T_a_b = T_chain_from.Inverse()};
  const UncertainPose2 from_to = from_chain * chain_to;
  return {.from = to - 1,
          .to = to,
          .T_from_to = from_to.T_a_b,
          .information = from_to.covariance.inverse()};
}

ScanMapOptions SubmapOptions(ScanMapOptions options) {
  options.insertion = InsertionRule::kNewSurface;
  options.max_density_points = std::min(options.max_density_points, kSubmapDensityPoints);
  return options;
}

}  // namespace

ScanChain::ScanChain(const MapperOptions& options)
    : map_options_(SubmapOptions(options.map)),
      locator_(options.locator),
      matcher_(options.locator.matcher) {}

void ScanChain::Add(const ScanNode& node) {
  const auto id = static_cast<NodeId>(T_chain_node_.size());
  const std::vector<ScanPoint> points = ToPoints(node.scan);
  if (id == 0) {
    T_chain_node_.push_back(node.map_robot.T_a_b);
  } else {
    const UncertainPose2 found = Attach(node, points);
    edges_.push_back(EdgeTo(id, T_chain_node_.back(), found));
    T_chain_node_.push_back(found.T_a_b);
  }
  T_map_last_ = node.map_robot.T_a_b;
  InsertIntoSubmaps(id, points);
}

// The last submap but one ends with the node before and began at least eight scans ago.
UncertainPose2 ScanChain::Attach(const ScanNode& node, std::span<const ScanPoint> points) const {
  const SurfaceMap& reference = last_surfaces_.front();
  const UncertainPose2 chain_last{.T_a_b = T_chain_node_.back()};
  UncertainPose2 predicted = AtLeast(chain_last * node.odometry, kLeastSigma_m, kLeastSigma_rad);
  if (!node.closed_loop) {
    predicted.T_a_b = chain_last.T_a_b * (T_map_last_.Inverse() * node.map_robot.T_a_b);
  }
  MatchPrior prior{.predicted = predicted,
                   .start = predicted.T_a_b,
                   .start_error = {.translation_m = locator_.search_error_m}};
  MatchResult match = matcher_.Match(reference, points, prior);
  if (!IsRecognised(match, kMinOverlapWithLast)) {
    prior.start_error = kStartError;
    match = matcher_.Match(reference, points, prior);
  }
  if (!IsFound(match)) {
    predicted = AtLeast(predicted, kSlipSigma_m, kSlipSigma_rad);
    match = LocateAmong(reference, points, predicted, locator_, matcher_);
    if (!IsRecognised(match, kMinOverlapWithLast)) return predicted;
  }
  const Eigen::Matrix3d information =
      InformationOfPairs(match, matcher_.options()) + predicted.covariance.inverse();
  return {.T_a_b = match.T_ref_cur, .covariance = information.inverse()};
}

void ScanChain::InsertIntoSubmaps(NodeId id, std::span<const ScanPoint> points) {
  if (id % kSubmapStep == 0) {
    submaps_.push_back({.first = id, .end = id});
    last_surfaces_.emplace_back(map_options_.surfaces);
    if (last_surfaces_.size() > 2) last_surfaces_.pop_front();
  }
  for (SurfaceMap& surfaces : last_surfaces_) Insert(id, points, surfaces);
  for (RigidSubmap& submap : std::span(submaps_).last(last_surfaces_.size())) submap.end = id + 1;
}

void ScanChain::Insert(NodeId id, std::span<const ScanPoint> points, SurfaceMap& surfaces) const {
  const UncertainPose2 chain_node{.T_a_b = T_chain_node_[id]};
  for (const MapPoint& point : PointsToStore(surfaces, points, chain_node, map_options_)) {
    surfaces.Insert(point, id);
  }
}

SurfaceMap ScanChain::SurfacesOf(const RigidSubmap& submap, std::span<const ScanNode> nodes) const {
  SurfaceMap surfaces(map_options_.surfaces);
  for (NodeId id = submap.first; id < submap.end; ++id) {
    Insert(id, ToPoints(nodes[id].scan), surfaces);
  }
  return surfaces;
}

UncertainPose2 ScanChain::Relative(NodeId from, NodeId to) const {
  UncertainPose2 relative;
  for (NodeId node = from; node < to; ++node) {
    const PoseEdge& edge = edges_[node];
    relative = relative *
               UncertainPose2{.T_a_b = edge.T_from_to, .covariance = edge.information.inverse()};
  }
  return relative;
}

}  // namespace qwsm
