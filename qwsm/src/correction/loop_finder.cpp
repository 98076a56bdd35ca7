// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "loop_finder.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "qwsm/geometry/along_axes.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "submap_match.hpp"

namespace qwsm {
namespace {

// Scans so near to a submap see the same surfaces.
constexpr double kReach_m = 4.0;
constexpr double kWindowSigmas = 3.0;
// What fits so near proves nothing of a scan that is as likely to be farther off.
constexpr double kMaxWindow_m = 15.0;
constexpr double kMinOverlap = 0.65;
// Fewer turns of its lasers after a submap the robot is still on the same pass.
constexpr std::size_t kTurnsBetweenPasses = 8;
// A single trunk tells where it stands, and not how the robot is turned.
constexpr double kMinTold = 1.5;
// What the error model does not know of: poses are never taken to be more certain.
constexpr double kModelSigma_m = 0.1;
constexpr double kModelSigma_rad = 0.02;

// How far off a scan may be expected that is in reach.
double ReachOf(double sigma_m) {
  return kReach_m + std::min(kMaxWindow_m, kWindowSigmas * sigma_m);
}

// What a match tells of the pose in a frame that is itself uncertain: the inverse of both
// covariances' sum, also where the match leaves a motion open or the frame is certain.
Eigen::Matrix3d InformationWith(const Eigen::Matrix3d& of_match, const Eigen::Matrix3d& frame) {
  const Eigen::Matrix3d information =
      of_match * (Eigen::Matrix3d::Identity() + frame * of_match).inverse();
  return 0.5 * (information + information.transpose());
}

// How the points of a scan fare where they were matched with a submap.
PlaceFit FitOf(const MatchResult& match,
               std::span<const ScanPoint> points,
               const SubmapSurfaces& submap) {
  const std::vector<ScanPoint> apart = PlaceEvidence::OneOfEachSurface(points);
  return {.told = PlaceEvidence::Told(apart),
          .explained = match.overlap,
          .seen_through = submap.ShareSeenThrough(apart, match.T_ref_cur)};
}

}  // namespace

std::vector<FoundLoop> LoopFinder::Find(NodeId first,
                                        const PoseEstimate& estimate,
                                        const LastSearch& last) const {
  std::vector<Candidate> candidates = NearPasses(first, estimate);
  std::vector<FoundLoop> found = RecogniseAll(candidates, last);
  const std::size_t unsettled = AddOlder(first, last.found, found);
  const auto order = [this](const FoundLoop& f) {
    return std::tuple(chains_.RobotOf(f.loop.edge.to), f.loop.edge.to, f.submap);
  };
  const auto to_confirm = std::span(found).first(unsettled);
  std::ranges::sort(to_confirm, {}, order);
  ConfirmByOthers(to_confirm, estimate, chains_);
  std::ranges::sort(found, {}, order);
  return found;
}

// Adds the loops of scans before the first one: those that new ones may yet confirm come before
// those that none can.
// @return how many loops there are without the latter.
std::size_t LoopFinder::AddOlder(NodeId first,
                                 std::span<const FoundLoop> last,
                                 std::vector<FoundLoop>& found) const {
  const auto is_older = [first](const FoundLoop& f) { return f.loop.edge.to < first; };
  const std::size_t news = found.size();
  found.reserve(news + static_cast<std::size_t>(std::ranges::count_if(last, is_older)));
  std::ranges::copy_if(last, std::back_inserter(found), is_older);
  const auto is_near_news = [&](const FoundLoop& old) {
    return std::ranges::any_of(std::span(found).first(news), [&](const FoundLoop& one) {
      return chains_.TurnsBetween(old.loop.edge.to, one.loop.edge.to).value_or(kSamePass + 1) <=
             kSamePass;
    });
  };
  const auto settled = std::ranges::partition(std::span(found).subspan(news), is_near_news);
  return found.size() - settled.size();
}

// Submap by submap, since the surfaces of few are kept.
std::vector<FoundLoop> LoopFinder::RecogniseAll(std::span<Candidate> candidates,
                                                const LastSearch& last) const {
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return std::pair(c.submap, c.node); });
  std::vector<FoundLoop> found;
  for (const Candidate& candidate : candidates) {
    const FoundLoop* known = LoopOf(candidate, last.found);
    const bool is_settled = candidate.node < last.end;
    if (known != nullptr && (is_settled || known->loop.verdict == LoopVerdict::kAccepted)) {
      found.push_back(*known);
      found.back().loop.verdict = LoopVerdict::kUnconfirmed;
      found.back().sigma_m = candidate.reference_node.SigmaXY_m();
      continue;
    }
    if (is_settled) continue;
    const RigidSubmap& submap = chains_.submaps()[candidate.submap];
    SubmapSurfaces& surfaces =
        recent_.Of({.submap = candidate.submap, .scans = submap.nodes.size()},
                   [&] { return chains_.SurfacesOf(submap, nodes_); });
    if (const auto loop = Recognise(candidate, surfaces)) found.push_back(*loop);
  }
  return found;
}

const FoundLoop* LoopFinder::LoopOf(const Candidate& candidate,
                                    std::span<const FoundLoop> loops) const {
  const auto key = [this](NodeId to, std::size_t submap) {
    return std::tuple(chains_.RobotOf(to), to, submap);
  };
  const auto found = std::ranges::lower_bound(
      loops, key(candidate.node, candidate.submap), {}, [&](const FoundLoop& f) {
        return key(f.loop.edge.to, f.submap);
      });
  const bool is_known = found != loops.end() && found->submap == candidate.submap &&
                        found->loop.edge.to == candidate.node &&
                        found->loop.edge.from == chains_.submaps()[candidate.submap].reference();
  return is_known ? &*found : nullptr;
}

// Of each pass of a scan, which is a row of submaps that it came near to, the nearest one.
class LoopFinder::NearestOfPasses {
 public:
  // @param submap of the candidate, each after those before it of the same robot.
  void Add(const Candidate& candidate, const RigidSubmap& submap) {
    const auto [entry, is_first] = last_passes_.try_emplace({candidate.node, submap.robot});
    Pass& last = entry->second;
    if (is_first || submap.ordinal != last.ordinal + 1) {
      last.nearest = nearest_.size();
      nearest_.push_back(candidate);
    } else if (candidate.distance_m < nearest_[last.nearest].distance_m) {
      nearest_[last.nearest] = candidate;
    }
    last.ordinal = submap.ordinal;
  }

  std::vector<Candidate> Take() { return std::move(nearest_); }

 private:
  struct Pass {
    std::size_t ordinal = 0;  // Of its last submap so far.
    std::size_t nearest = 0;
  };

  std::map<std::pair<NodeId, std::size_t>, Pass> last_passes_;  // Of a scan among those of a robot.
  std::vector<Candidate> nearest_;
};

std::vector<LoopFinder::Candidate> LoopFinder::NearPasses(NodeId first,
                                                          const PoseEstimate& estimate) const {
  NearestOfPasses nearest;
  const std::span<const RigidSubmap> submaps = chains_.submaps();
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    const std::vector<NodeId> nodes = NodesInReach(first, submaps[i], estimate);
    if (nodes.empty()) continue;
    const auto seen = estimate.SeenFrom(submaps[i].reference(), nodes);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const double distance_m = seen[k].T_a_b.translation_m().norm();
      const double sigma_m = seen[k].SigmaXY_m();
      if (sigma_m > kMaxWindow_m || distance_m > ReachOf(sigma_m)) continue;
      nearest.Add({nodes[k], i, seen[k], distance_m}, submaps[i]);
    }
  }
  return nearest.Take();
}

// Later nodes that may be in reach, whatever their errors and the submap's have in common.
std::vector<NodeId> LoopFinder::NodesInReach(NodeId first,
                                             const RigidSubmap& submap,
                                             const PoseEstimate& estimate) const {
  std::vector<NodeId> nodes;
  const NodeId reference = submap.reference();
  const Eigen::Vector2d reference_m = estimate.T_map_node(reference).translation_m();
  for (NodeId node = std::max(first, submap.nodes.back()); node < nodes_.size(); ++node) {
    const std::optional<std::size_t> behind = chains_.TurnsBetween(submap.nodes.back(), node);
    if (!chains_.CompletesTurn(node) || (behind && *behind <= kTurnsBetweenPasses)) continue;
    const double apart_m = (estimate.T_map_node(node).translation_m() - reference_m).norm();
    if (apart_m <= ReachOf(estimate.SigmaXYAtMost_m(reference, node))) nodes.push_back(node);
  }
  return nodes;
}

std::optional<FoundLoop> LoopFinder::Recognise(const Candidate& candidate,
                                               SubmapSurfaces& surfaces) const {
  const RigidSubmap& submap = chains_.submaps()[candidate.submap];
  const Pose2& T_chain_reference = chains_.T_chain_node()[submap.reference()];
  UncertainPose2 expected = UncertainPose2{.T_a_b = T_chain_reference} * candidate.reference_node;
  expected.covariance += UncertainPose2::WithSigmas({}, kModelSigma_m, kModelSigma_rad).covariance;
  const std::vector<ScanPoint> points = chains_.PointsAround(candidate.node, nodes_);
  const MatchResult match = LocateAmong(surfaces, points, expected, locator_, matcher_);
  if (!IsRecognised(match, kMinOverlap)) return std::nullopt;
  const PlaceFit fit = FitOf(match, points, surfaces);
  if (fit.told < kMinTold) return std::nullopt;
  const Eigen::Matrix3d of_match = InformationOfPairs(match, matcher_.options());
  return FoundLoop{
      .loop = {.edge = {.from = submap.reference(),
                        .to = candidate.node,
                        .T_from_to = T_chain_reference.Inverse() * match.T_ref_cur,
                        .information = InformationWith(AlongAxesOf(T_chain_reference, of_match),
                                                       ErrorWithin(submap)),
                        .trust = EdgeTrust::kLoop},
               .overlap = match.overlap,
               .reduced_chi2 = match.reduced_chi2},
      .of_match = of_match,
      .submap = candidate.submap,
      .sigma_m = candidate.reference_node.SigmaXY_m(),
      .nats = fit.NatsInOwnMap()};
}

// How wrong the scans of a submap lie to its reference: that of one half way to its end.
Eigen::Matrix3d LoopFinder::ErrorWithin(const RigidSubmap& submap) const {
  const std::size_t size = submap.nodes.size();
  const NodeId half_way = submap.nodes[(size / 2 + size) / 2];
  return chains_.Relative(submap.reference(), half_way).covariance;
}

}  // namespace qwsm
