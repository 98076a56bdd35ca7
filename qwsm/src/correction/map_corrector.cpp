// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/map_corrector.hpp"

#include <algorithm>

#include "anchored_path.hpp"
#include "loop_finder.hpp"
#include "map_contradiction.hpp"
#include "pose_estimate.hpp"
#include "scan_chain.hpp"

namespace qwsm {
namespace {

// Loops are found from the answers first, and once more from the poses that followed from them.
constexpr int kRounds = 2;
// A loop that keeps less of its weight is contradicted by the rest of the graph.
constexpr double kMinWeight = 0.25;

std::vector<Pose2> AnsweredPosesOf(std::span<const ScanNode> nodes) {
  std::vector<Pose2> poses;
  poses.reserve(nodes.size());
  for (const ScanNode& node : nodes) poses.push_back(node.map_robot.T_a_b);
  return poses;
}

std::vector<PoseEdge> WithAccepted(std::span<const PoseEdge> backbone,
                                   std::span<const Loop> loops) {
  std::vector<PoseEdge> edges(backbone.begin(), backbone.end());
  for (const Loop& loop : loops) {
    if (loop.verdict == LoopVerdict::kAccepted) edges.push_back(loop.edge);
  }
  return edges;
}

bool AnyAccepted(std::span<const Loop> loops) {
  return std::ranges::count(loops, LoopVerdict::kAccepted, &Loop::verdict) > 0;
}

// Loops that the rest of the graph disagrees with. @param weights of the accepted ones.
void ContradictLoops(std::span<const double> weights, std::vector<Loop>& loops) {
  auto weight = weights.begin();
  for (Loop& loop : loops) {
    if (loop.verdict != LoopVerdict::kAccepted) continue;
    if (*weight++ < kMinWeight) loop.verdict = LoopVerdict::kContradicted;
  }
}

}  // namespace

std::string_view Name(LoopVerdict verdict) {
  switch (verdict) {
    case LoopVerdict::kAccepted:
      return "accepted";
    case LoopVerdict::kUnconfirmed:
      return "unconfirmed";
    case LoopVerdict::kContradicted:
      return "contradicted";
    case LoopVerdict::kRefused:
      return "refused";
  }
  return "unknown";
}

struct MapCorrector::State {
  explicit State(const MapperOptions& mapper) : options(mapper), chain(mapper) {}

  Correction AsAnswered(std::vector<Loop> loops) const;
  Correction Refused(std::vector<Loop> loops) const;
  bool IsContradictedBy(const std::vector<Pose2>& T_map_node) const;

  MapperOptions options;
  ScanChain chain;
  std::vector<ScanNode> nodes;
  UncertainPose2 odometry;  // Since the last node.
  AnchoredPath path;
};

Correction MapCorrector::State::AsAnswered(std::vector<Loop> loops) const {
  Correction correction{.map_node = {},
                        .map_robot = path.AsAnswered(),
                        .graph = {.T_map_node = AnsweredPosesOf(nodes),
                                  .edges = {chain.edges().begin(), chain.edges().end()}},
                        .loops = std::move(loops)};
  for (const ScanNode& node : nodes) correction.map_node.push_back(node.map_robot);
  return correction;
}

Correction MapCorrector::State::Refused(std::vector<Loop> loops) const {
  for (Loop& loop : loops) {
    if (loop.verdict == LoopVerdict::kAccepted) loop.verdict = LoopVerdict::kRefused;
  }
  return AsAnswered(std::move(loops));
}

// The map is the judge: poses that are right explain at least what the answers explain.
bool MapCorrector::State::IsContradictedBy(const std::vector<Pose2>& T_map_node) const {
  return IsWorse(ContradictionAt(nodes, T_map_node, options.free_space),
                 ContradictionAt(nodes, AnsweredPosesOf(nodes), options.free_space));
}

MapCorrector::MapCorrector(const MapperOptions& options)
    : state_(std::make_unique<State>(options)) {}
MapCorrector::~MapCorrector() = default;
MapCorrector::MapCorrector(MapCorrector&&) noexcept = default;
MapCorrector& MapCorrector::operator=(MapCorrector&&) noexcept = default;

void MapCorrector::Take(const MappingStep& step) {
  State& state = *state_;
  state.path.Take(step);
  state.odometry = state.odometry * step.odometry_motion;
  if (!step.relevant) return;
  state.nodes.push_back({.scan = step.relevant_scan,
                         .map_robot = step.map_robot,
                         .odometry = state.odometry,
                         .closed_loop = step.closed_loop});
  state.chain.Add(state.nodes.back());
  state.odometry = {};
}

Correction MapCorrector::Correct() const {
  const State& state = *state_;
  Correction correction;
  correction.graph.T_map_node = AnsweredPosesOf(state.nodes);
  const LoopFinder finder(state.options, state.nodes, state.chain);
  const SparseGraphSolver solver;
  std::unique_ptr<PoseEstimate> estimate = std::make_unique<AnsweredPoses>(state.nodes);
  for (int round = 0; round < kRounds; ++round) {
    correction.loops = finder.Find(*estimate, correction.loops);
    if (!AnyAccepted(correction.loops)) return state.AsAnswered(std::move(correction.loops));
    correction.graph.edges = WithAccepted(state.chain.edges(), correction.loops);
    const GraphSolution solution = solver.Solve(correction.graph);
    if (!solution.is_converged) return state.Refused(std::move(correction.loops));
    correction.graph.T_map_node = solution.T_map_node;
    ContradictLoops(std::span(solution.weights).subspan(state.chain.edges().size()),
                    correction.loops);
    auto solved = std::make_unique<SolvedPoses>(correction.graph, solution);
    correction.map_node = solved->map_node();
    estimate = std::move(solved);
  }
  if (state.IsContradictedBy(correction.graph.T_map_node)) {
    return state.Refused(std::move(correction.loops));
  }
  correction.map_robot = state.path.At(correction.map_node);
  return correction;
}

ScanMap Reinserted(const ScanMap& map, const std::vector<UncertainPose2>& map_node) {
  ScanMap corrected(map.options());
  for (const RelevantScan& scan : map.scans()) {
    corrected.Insert(scan.scan, ToPoints(scan.scan), map_node[scan.id]);
  }
  return corrected;
}

}  // namespace qwsm
