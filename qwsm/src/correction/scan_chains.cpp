// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scan_chains.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "qwsm/geometry/along_axes.hpp"
#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/paths_apart.hpp"
#include "qwsm/mapping/pose_prediction.hpp"
#include "submap_match.hpp"

namespace qwsm {
namespace {

constexpr int kSubmapTurns = 16;
constexpr std::size_t kSubmapStep = kSubmapTurns / 2;
// Submaps serve scans that are like those in them: few points tell as much as many.
constexpr int kSubmapDensityPoints = 2;
// Odometry between two relevant scans is never better than this.
constexpr double kLeastSigma_m = 0.01;
constexpr double kLeastSigma_rad = 0.003;
// Between two scans of one turn the answers are better: what all lasers told is in them.
constexpr double kTurnSigma_m = 0.001;
constexpr double kTurnSigma_rad = 0.001;
// What a slip of the wheels, or a push, does.
constexpr double kSlipSigma_m = 0.4;
constexpr double kSlipSigma_rad = 0.15;
constexpr double kMinOverlapWithLast = 0.5;
// One scan that fits nothing may be a bad one; after so many, what was seen before may lie
// anywhere.
constexpr int kUnmatchedInARow = 2;
// How far the answers may be off as a first guess.
constexpr StartError kStartError{.translation_m = 0.1, .rotation_rad = 0.02};

UncertainPose2 AtLeast(const UncertainPose2& pose, double sigma_m, double sigma_rad) {
  UncertainPose2 wider = pose;
  wider.covariance += UncertainPose2::WithSigmas({}, sigma_m, sigma_rad).covariance;
  return wider;
}

// A motion is as uncertain as odometry is, and as what is believed of it is apart from that: where
// the map has called a robot back, the answers have moved and the robot has not.
UncertainPose2 PredictedAfter(const UncertainPose2& chain_last, const ScanNode& node) {
  const UncertainPose2 by_odometry =
      AtLeast(chain_last * node.odometry, kLeastSigma_m, kLeastSigma_rad);
  if (!node.T_last_node) return by_odometry;
  return About(chain_last.T_a_b * *node.T_last_node, by_odometry);
}

// The motion where no scan tells whether the wheels have slipped: as they do once in a hundred.
UncertainPose2 PerhapsSlipped(const UncertainPose2& moved) {
  const double share = std::exp(-0.5 * kSlipNats);
  return AtLeast(moved, share * kSlipSigma_m, share * kSlipSigma_rad);
}

// The edge to a pose that was found in the frame of another: its covariance is along that frame's
// axes, the edge's along those of `from`.
PoseEdge EdgeTo(NodeId from, NodeId to, const Pose2& T_chain_from, const UncertainPose2& chain_to) {
  const UncertainPose2 from_chain{.T_a_b = T_chain_from.Inverse()};
  const UncertainPose2 from_to = from_chain * chain_to;
  return {.from = from,
          .to = to,
          .T_from_to = from_to.T_a_b,
          .information = from_to.covariance.inverse()};
}

// By how much the answer has become more uncertain since the node before, along the chain's axes.
Eigen::Matrix3d Growth(const ScanNode& node,
                       const ScanNode& last,
                       const UncertainPose2& chain_last) {
  if (!node.T_last_node) return Eigen::Matrix3d::Zero();
  return (chain_last * Since(last.map_robot, node.map_robot)).covariance;
}

ScanMapOptions SubmapOptions(ScanMapOptions options) {
  options.insertion = InsertionRule::kNewSurface;
  options.max_density_points = std::min(options.max_density_points, kSubmapDensityPoints);
  return options;
}

// All scans of a submap count, and however many points end in what they saw free.
FreeSpaceOptions OfAllScans(FreeSpaceOptions options) {
  options.scans = kSubmapTurns;
  options.max_moving_share = 1.0;
  return options;
}

}  // namespace

ScanChains::ScanChains(const MapperOptions& options)
    : map_options_(SubmapOptions(options.map)),
      free_space_(OfAllScans(options.free_space)),
      locator_(options.locator),
      matcher_(options.locator.matcher) {}

void ScanChains::Add(std::span<const ScanNode> nodes) {
  const auto id = static_cast<NodeId>(T_chain_node_.size());
  const ScanNode& node = nodes[id];
  Chain& chain = chains_[node.robot];
  position_.push_back(chain.nodes.size());
  robot_.push_back(node.robot);
  parts_.push_back(chain.turns.Take(id, node.scan.geometry.T_robot_laser));
  const std::vector<ScanPoint> points = ToPoints(node.scan);
  if (chain.nodes.empty()) {
    Begin(node);
  } else {
    const NodeId last = chain.nodes.back();
    const bool hangs = !parts_[id].completes && node.T_last_node;
    const Attachment attached = hangs ? Hang(node, chain) : Attach(id, points, nodes, chain);
    edges_.push_back(EdgeTo(last, id, T_chain_node_[last], attached.chain_node));
    T_chain_node_.push_back(attached.chain_node.T_a_b);
    NoteMotion(attached);
    NoteMatch(id, attached, chain);
    if (!hangs) NoteHold(attached, chain);
  }
  chain.nodes.push_back(id);
  unmatched_.push_back(chain.unmatched);
  InsertIntoSubmaps(id, points, chain);
}

void ScanChains::ForgetSince(std::span<const ScanNode> nodes) {
  const auto first = static_cast<NodeId>(nodes.size());
  ForgetSubmapsSince(first);
  std::erase_if(matches_, [&](const SurfaceMatch& match) { return match.node >= first; });
  std::erase_if(edges_, [&](const PoseEdge& edge) { return edge.to >= first; });
  std::erase_if(motions_, [&](const PoseEdge& edge) { return edge.to >= first; });
  T_chain_node_.resize(first);
  position_.resize(first);
  robot_.resize(first);
  parts_.resize(first);
  unmatched_.resize(first);
  std::erase_if(chains_, [&](const auto& chain) { return chain.second.nodes.front() >= first; });
  for (auto& [robot, chain] : chains_) {
    if (chain.nodes.back() < first) continue;
    std::erase_if(chain.nodes, [&](NodeId node) { return node >= first; });
    GoOn(nodes, chain);
  }
}

// What was begun first has the least number. The first node that was matched told how wrong the
// surfaces lie.
void ScanChains::ForgetSubmapsSince(NodeId first) {
  std::erase_if(submaps_, [&](const RigidSubmap& one) { return one.nodes.front() >= first; });
  for (RigidSubmap& submap : submaps_) {
    if (submap.nodes.back() < first) continue;
    std::erase_if(submap.nodes, [&](NodeId node) { return node >= first; });
    const auto is_of_it = [&](const SurfaceMatch& match) {
      return match.node < first && match.node > submap.nodes.front() &&
             std::ranges::binary_search(submap.nodes, match.node);
    };
    if (std::ranges::none_of(matches_, is_of_it)) submap.error_of_surfaces.setZero();
  }
}

// After the last node that is left. Submaps that still grew have it.
void ScanChains::GoOn(std::span<const ScanNode> nodes, Chain& chain) {
  const NodeId last = chain.nodes.back();
  chain.unmatched = unmatched_[last];
  chain.turns = {};
  for (const NodeId id : chain.nodes) {
    chain.turns.Take(id, nodes[id].scan.geometry.T_robot_laser);
  }
  std::erase_if(chain.submaps, [&](std::size_t index) { return index >= submaps_.size(); });
  chain.last_surfaces.clear();
  for (const std::size_t index : chain.submaps) {
    const RigidSubmap& submap = submaps_[index];
    if (submap.nodes.back() != last) continue;
    chain.last_surfaces.push_back(Drawn(submap, nodes));
  }
}

// What is known of where a further robot came in: its pose in the map, or as seen from a node
// there.
void ScanChains::Begin(const ScanNode& node) {
  const auto id = static_cast<NodeId>(T_chain_node_.size());
  T_chain_node_.push_back(node.map_robot.T_a_b);
  if (id == 0) {
    map_first_ = node.map_robot;
    return;
  }
  if (node.found) {
    const UncertainPose2 found = AtLeast(node.found->node_robot, kLeastSigma_m, kLeastSigma_rad);
    edges_.push_back(EdgeTo(node.found->node, id, {}, found));
  } else {
    const UncertainPose2 entered = AtLeast(node.map_robot, kLeastSigma_m, kLeastSigma_rad);
    edges_.push_back(EdgeTo(0, id, map_first_.T_a_b, entered));
  }
  motions_.push_back(edges_.back());
}

// An edge without what the match tells.
void ScanChains::NoteMotion(const Attachment& attached) {
  PoseEdge motion = edges_.back();
  motion.information = AlongAxesOf(T_chain_node_[motion.from], attached.of_motion);
  motions_.push_back(motion);
}

// It was matched with the last submap but one, and helps to draw the last two.
void ScanChains::NoteMatch(NodeId id, const Attachment& attached, const Chain& chain) {
  if (attached.of_match.isZero()) return;
  const auto growing = std::span(chain.submaps).last(chain.last_surfaces.size());
  matches_.push_back({.submap = growing.front(), .node = id, .information = attached.of_match});
  for (const std::size_t index : growing) {
    Eigen::Matrix3d& error = submaps_[index].error_of_surfaces;
    if (error.isZero()) error = attached.chain_node.covariance;
  }
}

ScanChains::Attachment ScanChains::Hang(const ScanNode& node, const Chain& chain) const {
  const UncertainPose2 chain_last{.T_a_b = T_chain_node_[chain.nodes.back()]};
  const UncertainPose2 answered{.T_a_b = *node.T_last_node, .covariance = node.odometry.covariance};
  const UncertainPose2 hung = AtLeast(chain_last * answered, kTurnSigma_m, kTurnSigma_rad);
  return {.chain_node = hung, .of_motion = hung.covariance.inverse()};
}

std::vector<ScanPoint> ScanChains::WithThoseBeside(std::vector<ScanPoint> points,
                                                   NodeId node,
                                                   const Pose2& T_chain_robot,
                                                   std::span<const ScanNode> nodes) const {
  for (const NodeId other : parts_[node].beside) {
    const RigidTransform2 T_robot_other(T_chain_robot.Inverse() * T_chain_node_[other]);
    for (const ScanPoint& point : ToPoints(nodes[other].scan)) {
      points.push_back(T_robot_other * point);
    }
  }
  return points;
}

// The wheels err the same way for long: by how much the answer has become more uncertain with the
// motion, the motion is more uncertain than the noise of its steps tells.
ScanChains::Attachment ScanChains::Matched(const MatchResult& match,
                                           const UncertainPose2& predicted,
                                           const Eigen::Matrix3d& growth) const {
  const Eigen::Matrix3d of_match = InformationOfPairs(match, matcher_.options());
  const Eigen::Matrix3d information = of_match + predicted.covariance.inverse();
  return {.chain_node = {.T_a_b = match.T_ref_cur, .covariance = information.inverse()},
          .of_motion = (predicted.covariance + growth).inverse(),
          .of_match = of_match};
}

// The last submap but one ends with the node before and began at least eight turns ago.
ScanChains::Attachment ScanChains::Attach(NodeId id,
                                          const std::vector<ScanPoint>& own_points,
                                          std::span<const ScanNode> nodes,
                                          Chain& chain) const {
  const ScanNode& node = nodes[id];
  SubmapSurfaces& reference = chain.last_surfaces.front();
  const UncertainPose2 chain_last{.T_a_b = T_chain_node_[chain.nodes.back()]};
  const UncertainPose2 predicted = PredictedAfter(chain_last, node);
  const std::vector<ScanPoint> points = WithThoseBeside(own_points, id, predicted.T_a_b, nodes);
  MatchPrior prior{.predicted = predicted,
                   .start = predicted.T_a_b,
                   .start_error = {.translation_m = locator_.search_error_m}};
  MatchResult match = matcher_.Match(reference.surfaces(), points, prior);
  if (!IsRecognised(match, kMinOverlapWithLast)) {
    prior.start_error = kStartError;
    match = matcher_.Match(reference.surfaces(), points, prior);
  }
  const Eigen::Matrix3d growth = Growth(node, nodes[chain.nodes.back()], chain_last);
  if (HasMatched(match)) return Matched(match, predicted, growth);
  const UncertainPose2 slipped = AtLeast(predicted, kSlipSigma_m, kSlipSigma_rad);
  const MatchResult elsewhere = LocateAmong(reference, points, slipped, locator_, matcher_);
  if (IsRecognised(elsewhere, kMinOverlapWithLast) &&
      IsSlipTold(points, predicted, elsewhere, match)) {
    return Matched(elsewhere, slipped, growth);
  }
  const UncertainPose2 reckoned = PerhapsSlipped(predicted);
  return {.chain_node = reckoned, .of_motion = reckoned.covariance.inverse()};
}

// Scans are not rigid with surfaces by which none was held for a while.
void ScanChains::NoteHold(const Attachment& attached, Chain& chain) {
  chain.unmatched = attached.of_match.isZero() ? chain.unmatched + 1 : 0;
  if (chain.unmatched >= kUnmatchedInARow) chain.last_surfaces.clear();
}

void ScanChains::BeginSubmap(NodeId id, Chain& chain) {
  const std::size_t ordinal = chain.submaps.size();
  chain.submaps.push_back(submaps_.size());
  submaps_.push_back({.robot = robot_[id], .ordinal = ordinal, .nodes = {}});
  chain.last_surfaces.emplace_back(map_options_.surfaces, free_space_);
  if (chain.last_surfaces.size() > 2) chain.last_surfaces.pop_front();
}

void ScanChains::InsertIntoSubmaps(NodeId id, std::span<const ScanPoint> points, Chain& chain) {
  const bool is_due = parts_[id].begins && parts_[id].turn % kSubmapStep == 0;
  if (is_due || chain.last_surfaces.empty()) BeginSubmap(id, chain);
  for (SubmapSurfaces& submap : chain.last_surfaces) Insert(id, points, submap);
  for (const std::size_t submap : std::span(chain.submaps).last(chain.last_surfaces.size())) {
    submaps_[submap].nodes.push_back(id);
  }
}

void ScanChains::Insert(NodeId id,
                        std::span<const ScanPoint> points,
                        SubmapSurfaces& submap) const {
  const UncertainPose2 chain_node{.T_a_b = T_chain_node_[id]};
  for (const MapPoint& point : PointsToStore(submap.surfaces(), points, chain_node, map_options_)) {
    submap.Insert(point, id);
  }
}

SubmapSurfaces ScanChains::Drawn(const RigidSubmap& submap, std::span<const ScanNode> nodes) const {
  SubmapSurfaces surfaces(map_options_.surfaces, free_space_);
  for (const NodeId id : submap.nodes) Insert(id, ToPoints(nodes[id].scan), surfaces);
  return surfaces;
}

SubmapSurfaces ScanChains::SurfacesOf(const RigidSubmap& submap,
                                      std::span<const ScanNode> nodes) const {
  SubmapSurfaces surfaces = Drawn(submap, nodes);
  for (const NodeId id : submap.nodes) surfaces.SeeFree(nodes[id].scan, T_chain_node_[id]);
  return surfaces;
}

UncertainPose2 ScanChains::Relative(NodeId from, NodeId to) const {
  UncertainPose2 relative;
  const Chain& chain = chains_.at(robot_[from]);
  for (std::size_t next = position_[from] + 1; next <= position_[to]; ++next) {
    relative = relative * MeasuredBy(edges_[chain.nodes[next] - 1]);
  }
  return relative;
}

}  // namespace qwsm
