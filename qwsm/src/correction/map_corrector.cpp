// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/map_corrector.hpp"

#include <algorithm>
#include <utility>

#include "loop_finder.hpp"
#include "map_contradiction.hpp"
#include "path_refinement.hpp"
#include "pose_estimate.hpp"
#include "scan_chains.hpp"
#include "tie_graph.hpp"

namespace qwsm {
namespace {

// Loops are found from the answers first, and once more from the poses that followed from them.
constexpr int kRounds = 2;
// A loop that keeps less of its weight is contradicted by the rest of the graph.
constexpr double kMinWeight = 0.25;
// While the robot drives, a graph is solved once it has so many times the loops it had before.
constexpr double kMoreLoops = 1.25;

std::vector<Pose2> PosesOf(std::span<const ScanNode> nodes) {
  std::vector<Pose2> poses;
  poses.reserve(nodes.size());
  for (const ScanNode& node : nodes) poses.push_back(node.map_robot.T_a_b);
  return poses;
}

std::vector<PoseEdge> WithAccepted(std::span<const PoseEdge> backbone,
                                   std::span<const FoundLoop> loops) {
  std::vector<PoseEdge> edges(backbone.begin(), backbone.end());
  for (const FoundLoop& found : loops) {
    if (found.loop.verdict == LoopVerdict::kAccepted) edges.push_back(found.loop.edge);
  }
  return edges;
}

std::size_t CountAccepted(std::span<const FoundLoop> loops) {
  return static_cast<std::size_t>(std::ranges::count_if(
      loops, [](const FoundLoop& f) { return f.loop.verdict == LoopVerdict::kAccepted; }));
}

// Loops that the rest of the graph disagrees with. @param weights of the accepted ones.
void ContradictLoops(std::span<const double> weights, std::vector<FoundLoop>& loops) {
  auto weight = weights.begin();
  for (FoundLoop& found : loops) {
    if (found.loop.verdict != LoopVerdict::kAccepted) continue;
    if (*weight++ < kMinWeight) found.loop.verdict = LoopVerdict::kContradicted;
  }
}

std::vector<Loop> LoopsOf(std::span<const FoundLoop> found) {
  std::vector<Loop> loops;
  loops.reserve(found.size());
  for (const FoundLoop& one : found) loops.push_back(one.loop);
  return loops;
}

// A graph at the poses that agree best with it.
struct SolvedGraph {
  PoseGraph graph;
  GraphSolution solution;

  // With their covariances, which take more memory than the graph.
  SolvedPoses poses() const { return SolvedPoses(graph, solution); }
};

// A submap is what a robot saw from one place and ends close by: a scan's points beyond its ends
// would turn a match, and let it be more certain than it is, and the mean of all that lies around
// an end lies aside of it.
MapperOptions MatchingSubmaps(MapperOptions options) {
  options.locator.matcher.selection = PairSelection::kOneToOne;
  options.locator.matcher.comparison = PairComparison::kNear;
  return options;
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
  explicit State(const MapperOptions& mapper) : options(MatchingSubmaps(mapper)), chains(options) {}

  void Look();
  std::optional<SolvedGraph> Solve(std::vector<FoundLoop>& found);
  void Refine(SolvedGraph& solved) const;
  std::vector<UncertainPose2> PosesIn(const SolvedGraph& solved,
                                      std::span<const FoundLoop> found) const;
  bool HasManyMoreLoops() const;
  NodeId EndOfSettled() const;
  Correction Unchanged(std::vector<FoundLoop> found) const;
  Correction Refused(std::vector<FoundLoop> found) const;
  Contradiction ContradictionAt(const std::vector<Pose2>& T_map_node) const {
    return qwsm::ContradictionAt(nodes, T_map_node, options.free_space);
  }

  MapperOptions options;
  ScanChains chains;
  std::vector<ScanNode> nodes;
  RecentSurfaces recent;
  std::vector<FoundLoop> loops;   // Found while the robots drive.
  NodeId looked_for = 0;          // Nodes before were looked for in submaps.
  bool has_moved = false;         // Whether nodes are elsewhere than they were looked for.
  std::size_t settled_loops = 0;  // As many as the map has been judged by.
};

// Looks for the nodes that are new.
void MapCorrector::State::Look() {
  const LoopFinder finder(options, nodes, chains, recent);
  loops = finder.Find(looked_for, AnsweredPoses(nodes), {.found = loops});
  looked_for = static_cast<NodeId>(nodes.size());
}

// Most of what is new changes nothing: so the work for a drive is as much as for its end.
bool MapCorrector::State::HasManyMoreLoops() const {
  const auto accepted = static_cast<double>(CountAccepted(loops));
  return accepted >= kMoreLoops * static_cast<double>(settled_loops) + 1.0;
}

// Nodes before were looked for in the end's submaps, from the same poses. Those of other robots may
// have grown since.
NodeId MapCorrector::State::EndOfSettled() const {
  return has_moved || chains.robots() > 1 ? 0 : looked_for;
}

// It is seldom done, and takes the room of surfaces that are made anew where they are asked for.
std::optional<SolvedGraph> MapCorrector::State::Solve(std::vector<FoundLoop>& found) {
  recent = {};
  PoseGraph graph{.T_map_node = PosesOf(nodes), .edges = WithAccepted(chains.edges(), found)};
  GraphSolution solution = SparseGraphSolver().Solve(graph);
  if (!solution.is_converged) return std::nullopt;
  ContradictLoops(std::span(solution.weights).subspan(chains.edges().size()), found);
  graph.T_map_node = solution.T_map_node;
  return SolvedGraph{.graph = std::move(graph), .solution = std::move(solution)};
}

// From where loops have the nodes, by all that was seen.
void MapCorrector::State::Refine(SolvedGraph& solved) const {
  const WeightedScanMatcher matcher(options.locator.matcher);
  std::vector<Pose2>& T_map_node = solved.graph.T_map_node;
  T_map_node = RefinedPath(nodes, chains, matcher, std::move(T_map_node));
}

// How uncertain they are, the ties tell.
std::vector<UncertainPose2> MapCorrector::State::PosesIn(const SolvedGraph& solved,
                                                         std::span<const FoundLoop> found) const {
  const PoseGraph ties = TieGraph(chains, solved.graph.T_map_node, found);
  const GraphSolution there{.T_map_node = ties.T_map_node,
                            .weights = std::vector<double>(ties.edges.size(), 1.0)};
  std::vector<UncertainPose2> poses = SolvedPoses(ties, there).map_node();
  poses.resize(nodes.size());  // Without those of surfaces.
  return poses;
}

Correction MapCorrector::State::Unchanged(std::vector<FoundLoop> found) const {
  Correction correction{.map_node = {},
                        .map_robot = {},
                        .graph = {.T_map_node = PosesOf(nodes),
                                  .edges = {chains.edges().begin(), chains.edges().end()}},
                        .loops = LoopsOf(found)};
  for (const ScanNode& node : nodes) correction.map_node.push_back(node.map_robot);
  return correction;
}

Correction MapCorrector::State::Refused(std::vector<FoundLoop> found) const {
  for (FoundLoop& one : found) {
    if (one.loop.verdict == LoopVerdict::kAccepted) one.loop.verdict = LoopVerdict::kRefused;
  }
  return Unchanged(std::move(found));
}

MapCorrector::MapCorrector(const MapperOptions& options)
    : state_(std::make_unique<State>(options)) {}
MapCorrector::~MapCorrector() = default;
MapCorrector::MapCorrector(MapCorrector&&) noexcept = default;
MapCorrector& MapCorrector::operator=(MapCorrector&&) noexcept = default;

void MapCorrector::Add(ScanNode node) {
  state_->nodes.push_back(std::move(node));
  state_->chains.Add(state_->nodes);
}

std::optional<std::vector<UncertainPose2>> MapCorrector::Propose() {
  State& state = *state_;
  state.Look();
  if (!state.HasManyMoreLoops()) return std::nullopt;
  const std::optional<SolvedGraph> solved = state.Solve(state.loops);
  if (!solved) return std::nullopt;
  if (IsMostlyResolved(state.ContradictionAt(solved->graph.T_map_node),
                       state.ContradictionAt(PosesOf(state.nodes)))) {
    return state.PosesIn(*solved, state.loops);
  }
  state.settled_loops = CountAccepted(state.loops);
  return std::nullopt;
}

void MapCorrector::Adopt(std::span<const UncertainPose2> map_node) {
  for (NodeId node = 0; node < map_node.size(); ++node) {
    state_->nodes[node].map_robot = map_node[node];
  }
  state_->settled_loops = CountAccepted(state_->loops);
  state_->has_moved = true;
}

// Submaps that are left keep their numbers; those that lose scans are not what loops came from.
void MapCorrector::ForgetSince(NodeId first) {
  State& state = *state_;
  std::erase_if(state.loops, [&](const FoundLoop& found) {
    return found.loop.edge.to >= first ||
           state.chains.submaps()[found.submap].nodes.back() >= first;
  });
  state.recent = {};
  state.nodes.erase(state.nodes.begin() + first, state.nodes.end());
  state.chains.ForgetSince(state.nodes);
  state.looked_for = std::min(state.looked_for, first);
  state.settled_loops = std::min(state.settled_loops, CountAccepted(state.loops));
}

ScanMap MapCorrector::MapAt(std::span<const UncertainPose2> map_node) const {
  ScanMap map(state_->options.map);
  for (NodeId node = 0; node < map_node.size(); ++node) {
    map.Insert(state_->nodes[node].scan, map_node[node]);
  }
  return map;
}

std::vector<RelevantScan> MapCorrector::ScansAt(std::span<const UncertainPose2> map_node) && {
  std::vector<RelevantScan> scans;
  scans.reserve(map_node.size());
  for (NodeId id = 0; id < map_node.size(); ++id) {
    LaserScan& scan = state_->nodes[id].scan;
    scans.push_back({.id = id, .scan = std::move(scan), .map_robot = map_node[id]});
  }
  state_.reset();
  return scans;
}

Correction MapCorrector::Correct() {
  State& state = *state_;
  const LoopFinder finder(state.options, state.nodes, state.chains, state.recent);
  const LastSearch search{.found = state.loops, .end = state.EndOfSettled()};
  std::vector<FoundLoop> found = finder.Find(0, AnsweredPoses(state.nodes), search);
  std::optional<SolvedGraph> solved;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) found = finder.Find(0, solved->poses(), {.found = found});
    if (CountAccepted(found) == 0) return state.Unchanged(std::move(found));
    solved = state.Solve(found);
    if (!solved) return state.Refused(std::move(found));
  }
  state.Refine(*solved);
  // The map is the judge: poses that are right explain at least what the answers explain.
  if (IsWorse(state.ContradictionAt(solved->graph.T_map_node),
              state.ContradictionAt(PosesOf(state.nodes)))) {
    return state.Refused(std::move(found));
  }
  return {.map_node = state.PosesIn(*solved, found),
          .map_robot = {},
          .graph = std::move(solved->graph),
          .loops = LoopsOf(found)};
}

}  // namespace qwsm
