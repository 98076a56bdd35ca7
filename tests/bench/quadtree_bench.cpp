// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// PointQuadtree against nanoflann's static and dynamic k-d trees, in turns: neighbours in matching,
// insertion, memory. Times are the quadtree's; counters say how many times the yardstick takes.
#include <benchmark/benchmark.h>
#include <time.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

// GCC 12 warns of a member that the dynamic tree copies before it is set.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <nanoflann.hpp>
#pragma GCC diagnostic pop

#include "qwsm/matching/surface_map.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"
#include "qwsm/search/point_quadtree.hpp"
#include "tests/bench/rooms.hpp"

namespace qwsm::bench {
namespace {

/// Time this thread has worked, whatever else the machine does.
double Now_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

constexpr std::size_t kBeams = 181;
constexpr double kMaxDistance_m = 0.15;
constexpr double kMaxDistance_m2 = kMaxDistance_m * kMaxDistance_m;
constexpr std::size_t kPointsPerRoom = 600;  // Every 3 cm of wall.
constexpr double kNone = std::numeric_limits<double>::infinity();

/// What nanoflann asks of a container.
struct Cloud {
  Points points_m;

  std::size_t kdtree_get_point_count() const { return points_m.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points_m[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Metric = nanoflann::L2_Simple_Adaptor<double, Cloud>;
using StaticTree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 2, std::uint32_t>;
using DynamicTree = nanoflann::KDTreeSingleIndexDynamicAdaptor<Metric, Cloud, 2, std::uint32_t>;

/// The nearest point within the bound: the same question that the quadtree is asked.
class BoundedNearest {
 public:
  using DistanceType = double;
  using IndexType = std::uint32_t;

  bool addPoint(double distance_m2, std::uint32_t) {
    if (distance_m2 < nearest_m2_) nearest_m2_ = distance_m2;
    return true;
  }
  double worstDist() const { return nearest_m2_; }
  bool full() const { return true; }
  std::size_t size() const { return nearest_m2_ < kBound_m2 ? 1 : 0; }
  double distance_m2() const { return size() > 0 ? nearest_m2_ : kNone; }

 private:
  static constexpr double kBound_m2 = kMaxDistance_m2 * (1.0 + 1e-12);
  double nearest_m2_ = kBound_m2;
};

template <class Tree>
double NearestInKdTree_m2(const Tree& tree, const Eigen::Vector2d& query_m) {
  BoundedNearest nearest;
  tree.findNeighbors(nearest, query_m.data(), nanoflann::SearchParams());
  return nearest.distance_m2();
}

double OrNone(const std::optional<Neighbor>& neighbor) {
  return neighbor ? neighbor->distance_m2 : kNone;
}

/// A map, and its points in all trees.
struct Trees {
  explicit Trees(std::size_t size) : building(size, kPointsPerRoom) {
    Random random(1);
    for (const Eigen::Vector2d& p_m : building.Sampled(random))
      surfaces.Insert({.p_map_m = p_m}, 0);
    // All trees hold the same points: those of one cell merged, and kept to a micrometre.
    cloud.points_m = quadtree().Positions();
    const nanoflann::KDTreeSingleIndexAdaptorParams parameters(10);
    static_tree = std::make_unique<StaticTree>(2, cloud, parameters);
    static_tree->buildIndex();
    dynamic_tree = std::make_unique<DynamicTree>(2, cloud, parameters);
  }

  const PointQuadtree& quadtree() const { return surfaces.quadtree(); }

  Building building;
  SurfaceMap surfaces;
  Cloud cloud;
  std::unique_ptr<StaticTree> static_tree;
  std::unique_ptr<DynamicTree> dynamic_tree;
};

/// They take long to build and Google Benchmark asks several times.
const Trees& TreesOf(std::size_t size) {
  static std::unique_ptr<Trees> trees;
  static std::size_t size_of_trees = 0;
  if (size_of_trees != size) {
    trees.reset();
    trees = std::make_unique<Trees>(size);
    size_of_trees = size;
  }
  return *trees;
}

/// The queries of one match: the scan's points at the pose of every iteration, from a first guess
/// as good as the correlative search leaves it.
std::vector<Points> QueriesOfMatch(const Trees& trees, Random& random) {
  const Standpoint standpoint = AnyStandpoint(trees.building, random);
  const std::vector<ScanPoint> points = ToPoints(ScanFrom(standpoint, kBeams, random));
  const Pose2 error{Uniform(random, -0.032, 0.032),
                    Uniform(random, -0.032, 0.032),
                    Uniform(random, -0.004, 0.004)};
  MatchPrior prior;
  prior.start = standpoint.T_map_robot() * error;
  prior.start_error.translation_m = 0.022;
  prior.predicted = {.T_a_b = prior.start,
                     .covariance = Eigen::Vector3d(2e-3, 2e-3, 1e-3).asDiagonal()};
  MatchTrace trace;
  static_cast<void>(WeightedScanMatcher().Match(trees.surfaces, points, prior, &trace));

  std::vector<Pose2> T_map_robot{prior.start};
  for (const MatchIteration& iteration : trace) T_map_robot.push_back(iteration.T_ref_cur);
  T_map_robot.pop_back();  // Nothing is searched at the last pose.
  std::vector<Points> queries_m(T_map_robot.size());
  for (std::size_t i = 0; i < queries_m.size(); ++i) {
    for (const ScanPoint& point : points) {
      queries_m[i].push_back(T_map_robot[i] * point.p_robot_m);
    }
  }
  return queries_m;
}

/// Asks for the neighbour of every query; adds the time it took, and keeps the answers.
template <class Search>
void Answer(const std::vector<Points>& queries_m,
            Search search,
            double& time_s,
            std::vector<double>& distances_m2) {
  distances_m2.clear();
  const double start_s = Now_s();
  for (const Points& iteration_m : queries_m) {
    for (std::size_t i = 0; i < iteration_m.size(); ++i) {
      distances_m2.push_back(search(iteration_m[i], i));
    }
  }
  time_s += Now_s() - start_s;
}

std::size_t CountDifferent(const std::vector<double>& a, const std::vector<double>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Rounding may put a point on either side of the bound.
    const double a_m = std::min(std::sqrt(a[i]), kMaxDistance_m);
    const double b_m = std::min(std::sqrt(b[i]), kMaxDistance_m);
    if (std::abs(a_m - b_m) > 1e-9) ++different;
  }
  return different;
}

/// Neighbours as the iterations of a match ask for them: successively, near where they asked
/// before.
void NeighborsInMatching(benchmark::State& state) {
  const Trees& trees = TreesOf(static_cast<std::size_t>(state.range(0)));
  Random random(2);
  std::array<double, 4> time_s{};
  std::array<std::vector<double>, 4> found_m2;
  std::size_t wrong = 0;
  std::size_t iterations = 0;
  std::vector<Points> queries_m;
  for (auto _ : state) {
    queries_m = QueriesOfMatch(trees, random);
    iterations += queries_m.size();
    const double before_s = time_s[0];
    std::vector<SearchCursor> cursors(kBeams);
    const auto cached = [&](const Eigen::Vector2d& q_m, std::size_t i) {
      if (i > 0 && cursors[i].revision == 0) cursors[i] = cursors[i - 1];
      return OrNone(trees.quadtree().Nearest(q_m, kMaxDistance_m, cursors[i]));
    };
    const auto uncached = [&](const Eigen::Vector2d& q_m, std::size_t) {
      return OrNone(trees.quadtree().Nearest(q_m, kMaxDistance_m));
    };
    const auto in_static = [&](const Eigen::Vector2d& q_m, std::size_t) {
      return NearestInKdTree_m2(*trees.static_tree, q_m);
    };
    const auto in_dynamic = [&](const Eigen::Vector2d& q_m, std::size_t) {
      return NearestInKdTree_m2(*trees.dynamic_tree, q_m);
    };
    Answer(queries_m, cached, time_s[0], found_m2[0]);
    Answer(queries_m, uncached, time_s[1], found_m2[1]);
    Answer(queries_m, in_static, time_s[2], found_m2[2]);
    Answer(queries_m, in_dynamic, time_s[3], found_m2[3]);
    for (const std::size_t method : {0, 1, 3}) {
      wrong += CountDifferent(found_m2[method], found_m2[2]);
    }
    state.SetIterationTime(time_s[0] - before_s);
  }
  const double queries = static_cast<double>(iterations * kBeams);
  state.counters["iterations"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["ns_per_query"] = time_s[0] / queries * 1e9;
  state.counters["static_over_cached"] = time_s[2] / time_s[0];
  state.counters["dynamic_over_cached"] = time_s[3] / time_s[0];
  state.counters["static_over_uncached"] = time_s[2] / time_s[1];
  state.counters["bytes_per_point_with_surfaces"] =
      static_cast<double>(trees.surfaces.bytes()) / static_cast<double>(trees.quadtree().size());
  state.counters["wrong"] = static_cast<double>(wrong);
}
BENCHMARK(NeighborsInMatching)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000);

/// Building a map point by point, in the order of scans.
void Insertion(benchmark::State& state) {
  const Building building(static_cast<std::size_t>(state.range(0)), kPointsPerRoom);
  Random random(1);
  const Cloud cloud{building.Sampled(random)};
  double quadtree_s = 0.0;
  double dynamic_s = 0.0;
  PointQuadtreeStatistics statistics;
  for (auto _ : state) {
    const double start_s = Now_s();
    PointQuadtree quadtree;
    for (const Eigen::Vector2d& p_m : cloud.points_m) quadtree.Insert(p_m, 0);
    const double middle_s = Now_s();
    const DynamicTree dynamic_tree(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    dynamic_s += Now_s() - middle_s;
    quadtree_s += middle_s - start_s;
    state.SetIterationTime(middle_s - start_s);
    statistics = quadtree.Statistics();
  }
  const auto points = static_cast<double>(statistics.points);
  state.counters["Mpoints_per_s"] =
      1e-6 * points * static_cast<double>(state.iterations()) / quadtree_s;
  state.counters["dynamic_over_quadtree"] = dynamic_s / quadtree_s;
  state.counters["bytes_per_point"] = static_cast<double>(statistics.bytes) / points;
  state.counters["depth"] = statistics.depth;
}
BENCHMARK(Insertion)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000);

}  // namespace
}  // namespace qwsm::bench
