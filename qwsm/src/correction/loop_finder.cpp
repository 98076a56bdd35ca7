// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "loop_finder.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "submap_match.hpp"

namespace qwsm {
namespace {

// Scans so near to a submap see the same surfaces.
constexpr double kReach_m = 4.0;
constexpr double kWindowSigmas = 3.0;
constexpr double kMaxWindow_m = 5.0;
constexpr double kMinOverlap = 0.65;
// Fewer nodes after a submap the robot is still on the same pass.
constexpr NodeId kNodesBetweenPasses = 8;
// What the error model does not know of: poses are never taken to be more certain.
constexpr double kModelSigma_m = 0.1;
constexpr double kModelSigma_rad = 0.02;

double ReachOf(const UncertainPose2& expected) {
  return kReach_m + std::min(kMaxWindow_m, kWindowSigmas * expected.SigmaXY_m());
}

// What a match tells of the pose in a frame that is itself uncertain.
Eigen::Matrix3d InformationWith(const Eigen::Matrix3d& of_match, const Eigen::Matrix3d& frame) {
  const Eigen::Matrix3d of_frame = frame.inverse();
  return of_frame - of_frame * (of_match + of_frame).inverse() * of_frame;
}

}  // namespace

std::vector<Loop> LoopFinder::Find(const PoseEstimate& estimate, std::span<const Loop> last) const {
  ReferencePoses references;
  std::vector<Candidate> candidates = NearPasses(estimate, references);
  std::vector<FoundLoop> found = RecogniseAll(candidates, last);
  std::ranges::sort(
      found, {}, [](const FoundLoop& f) { return std::pair(f.loop.edge.to, f.submap); });
  ConfirmByOthers(found, references, chain_);
  std::vector<Loop> loops;
  loops.reserve(found.size());
  for (const FoundLoop& one : found) loops.push_back(one.loop);
  return loops;
}

// Submap by submap, since the surfaces of one are made for it.
std::vector<FoundLoop> LoopFinder::RecogniseAll(std::span<Candidate> candidates,
                                                std::span<const Loop> last) const {
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::pair(c.submap, c.node); });
  std::vector<FoundLoop> found;
  std::optional<SurfaceMap> surfaces;
  std::size_t of_submap = 0;
  for (const Candidate& candidate : candidates) {
    if (const Loop* known = AcceptedAmong(last, candidate)) {
      found.push_back({*known, candidate.submap});
      continue;
    }
    if (!surfaces || of_submap != candidate.submap) {
      of_submap = candidate.submap;
      surfaces = chain_.SurfacesOf(chain_.submaps()[of_submap], nodes_);
    }
    if (const auto loop = Recognise(candidate, *surfaces)) found.push_back({*loop, of_submap});
  }
  return found;
}

const Loop* LoopFinder::AcceptedAmong(std::span<const Loop> loops,
                                      const Candidate& candidate) const {
  const std::pair ends(candidate.node, chain_.submaps()[candidate.submap].reference());
  const auto loop = std::ranges::lower_bound(
      loops, ends, {}, [](const Loop& l) { return std::pair(l.edge.to, l.edge.from); });
  const bool is_accepted = loop != loops.end() && loop->edge.to == ends.first &&
                           loop->edge.from == ends.second &&
                           loop->verdict == LoopVerdict::kAccepted;
  return is_accepted ? &*loop : nullptr;
}

// Of each pass, which is a row of submaps that came near, the nearest one.
std::vector<LoopFinder::Candidate> LoopFinder::NearPasses(const PoseEstimate& estimate,
                                                          ReferencePoses& references) const {
  std::vector<Candidate> near;
  const std::span<const RigidSubmap> submaps = chain_.submaps();
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    std::vector<NodeId> nodes;
    for (const RigidSubmap& later : submaps.subspan(i)) nodes.push_back(later.reference());
    const auto later_submaps = std::ssize(nodes);
    AppendNodesInReach(submaps[i], estimate, nodes);
    const auto seen = estimate.SeenFrom(submaps[i].reference(), nodes);
    references.Add({seen.begin(), seen.begin() + later_submaps});
    for (auto k = static_cast<std::size_t>(later_submaps); k < seen.size(); ++k) {
      const double distance_m = seen[k].T_a_b.translation_m().norm();
      if (distance_m <= ReachOf(seen[k])) near.push_back({nodes[k], i, seen[k], distance_m});
    }
  }
  std::ranges::sort(near, {}, [](const Candidate& c) { return std::pair(c.node, c.submap); });
  return NearestOfEachPass(near);
}

// Later nodes that may be in reach, however uncertain they are.
void LoopFinder::AppendNodesInReach(const RigidSubmap& submap,
                                    const PoseEstimate& estimate,
                                    std::vector<NodeId>& nodes) const {
  const Eigen::Vector2d reference_m = estimate.T_map_node(submap.reference()).translation_m();
  for (NodeId node = submap.end + kNodesBetweenPasses; node < nodes_.size(); ++node) {
    const Eigen::Vector2d apart_m = estimate.T_map_node(node).translation_m() - reference_m;
    if (apart_m.norm() <= kReach_m + kMaxWindow_m) nodes.push_back(node);
  }
}

std::vector<LoopFinder::Candidate> LoopFinder::NearestOfEachPass(std::span<const Candidate> near) {
  std::vector<Candidate> nearest;
  const Candidate* last = nullptr;
  for (const Candidate& candidate : near) {
    const bool same_pass =
        last != nullptr && candidate.node == last->node && candidate.submap == last->submap + 1;
    if (!same_pass) {
      nearest.push_back(candidate);
    } else if (candidate.distance_m < nearest.back().distance_m) {
      nearest.back() = candidate;
    }
    last = &candidate;
  }
  return nearest;
}

std::optional<Loop> LoopFinder::Recognise(const Candidate& candidate,
                                          const SurfaceMap& surfaces) const {
  const RigidSubmap& submap = chain_.submaps()[candidate.submap];
  const Pose2& T_chain_reference = chain_.T_chain_node()[submap.reference()];
  UncertainPose2 expected = UncertainPose2{.T_a_b = T_chain_reference} * candidate.reference_node;
  expected.covariance += UncertainPose2::WithSigmas({}, kModelSigma_m, kModelSigma_rad).covariance;
  const MatchResult match =
      LocateAmong(surfaces, ToPoints(nodes_[candidate.node].scan), expected, locator_, matcher_);
  if (!IsRecognised(match, kMinOverlap)) return std::nullopt;
  Eigen::Matrix3d R_chain_reference = Eigen::Matrix3d::Identity();
  R_chain_reference.topLeftCorner<2, 2>() = T_chain_reference.Rotation();
  const Eigen::Matrix3d of_match = R_chain_reference.transpose() *
                                   InformationOfPairs(match, matcher_.options()) *
                                   R_chain_reference;
  return Loop{.edge = {.from = submap.reference(),
                       .to = candidate.node,
                       .T_from_to = T_chain_reference.Inverse() * match.T_ref_cur,
                       .information = InformationWith(of_match, ErrorWithin(submap)),
                       .trust = EdgeTrust::kLoop},
              .overlap = match.overlap,
              .reduced_chi2 = match.reduced_chi2};
}

// How wrong the scans of a submap lie to its reference: that of one half way to its end.
Eigen::Matrix3d LoopFinder::ErrorWithin(const RigidSubmap& submap) const {
  const NodeId half_way = (submap.reference() + submap.end) / 2;
  return chain_.Relative(submap.reference(), half_way).covariance;
}

}  // namespace qwsm
