// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Neighbour search over whole registrations, against nanoflann in the same run.
//
// A point-to-point registration is run once; its poses are then replayed, and at each of them every
// method searches the neighbours of all points, taking turns. All distances are compared. nanoflann
// is asked in the order of the tree, which suits it better than the order of the file.
#include <cstdio>
#include <vector>

#include "tests/bench/scan_pairs.hpp"

namespace slam6d::bench {
namespace {

constexpr double kMaxDistance_m = 0.5;

struct Times {
  double nanoflann_ms = 0.0;
  double nanoflann_first_ms = 0.0;
  double root_ms = 0.0;
  double cached_ms = 0.0;
  double cached_first_ms = 0.0;
  std::size_t wrong = 0;
  SearchStatistics cached;
};

std::size_t CountWrong(const std::vector<double>& distances2_m2,
                       const CachedSearch& root,
                       const CachedSearch& cached) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < distances2_m2.size(); ++i) {
    const double expected = distances2_m2[i];
    const bool found = expected < kMaxDistance_m * kMaxDistance_m;
    for (const CachedSearch* search : {&root, &cached}) {
      const bool same =
          search->found(i) == found && (!found || search->distance2_m2(i) == expected);
      wrong += same ? 0 : 1;
    }
  }
  return wrong;
}

Times Replay(const ScanPair& pair, const KdTreeOptions& tree, const NanoflannTree* nanoflann) {
  const ScanModel ref(pair.ref, tree);
  const ScanModel cur(pair.cur, tree);
  IcpTrace trace;
  const IcpOptions options{.metric = IcpMetric::kPointToPoint, .max_distance_m = kMaxDistance_m};
  static_cast<void>(Align(ref, cur, pair.T_ref_cur_guess, options, &trace));
  trace.pop_back();  // No neighbours are searched at the last pose.

  const std::size_t size = cur.points.size();
  CachedSearch root(
      ref.tree, cur.points, {.max_distance_m = kMaxDistance_m, .start = SearchStart::kRoot});
  CachedSearch cached(ref.tree, cur.points, {.max_distance_m = kMaxDistance_m});
  std::vector<double> distances2_m2(size);
  Times times;
  for (const Pose3& T_ref_cur : trace) {
    const PointCloud queries = T_ref_cur * cur.points;
    const bool first = &T_ref_cur == &trace.front();
    if (nanoflann != nullptr) {
      const double ms = Milliseconds([&] {
        for (std::size_t i = 0; i < size; ++i) {
          distances2_m2[i] = nanoflann->FindNearest(queries[i]).distance2_m2;
        }
      });
      times.nanoflann_ms += ms;
      if (first) times.nanoflann_first_ms = ms;
    }
    times.root_ms += Milliseconds([&] {
      root.MoveTo(T_ref_cur);
      root.Find(0, size);
    });
    const double ms = Milliseconds([&] {
      cached.MoveTo(T_ref_cur);
      times.cached += cached.Find(0, size);
    });
    times.cached_ms += ms;
    if (first) times.cached_first_ms = ms;
    if (nanoflann != nullptr) times.wrong += CountWrong(distances2_m2, root, cached);
  }
  return times;
}

void CompareWithNanoflann(const std::vector<ScanPair>& pairs, const KdTreeOptions& tree) {
  std::puts("search over a registration, CPU ms, one thread; ratio = nanoflann / cached");
  std::puts("          iterations nanoflann     root   cached  ratio  first: ratio  proven  wrong");
  for (const ScanPair& pair : pairs) {
    const NanoflannTree nanoflann(pair.ref);
    const Times t = Replay(pair, tree, &nanoflann);
    const auto queries = static_cast<double>(t.cached.queries);
    std::printf("%-10s %10.0f %9.1f %8.1f %8.1f %6.2f %13.2f %6.1f%% %6zu\n",
                pair.name.c_str(),
                queries / static_cast<double>(pair.cur.size()),
                t.nanoflann_ms,
                t.root_ms,
                t.cached_ms,
                t.nanoflann_ms / t.cached_ms,
                t.nanoflann_first_ms / t.cached_first_ms,
                100.0 * static_cast<double>(t.cached.proven_unchanged) / queries,
                t.wrong);
  }
}

void CompareWithRoot(const std::vector<ScanPair>& pairs, KdTreeOptions tree) {
  std::puts("\ncached against own search from the root: time saved per registration");
  std::printf("bucket size");
  for (const ScanPair& pair : pairs) std::printf(" %9s", pair.name.c_str());
  for (const int bucket_size : {1, 2, 4, 8, 16, 25, 35, 50}) {
    std::printf("\n%11d", bucket_size);
    tree.bucket_size = bucket_size;
    for (const ScanPair& pair : pairs) {
      const Times t = Replay(pair, tree, nullptr);
      std::printf(" %8.0f%%", 100.0 * (1.0 - t.cached_ms / t.root_ms));
    }
  }
  std::puts("");
}

}  // namespace
}  // namespace slam6d::bench

int main(int argc, char** argv) {
  const std::vector<slam6d::bench::ScanPair> pairs = slam6d::bench::ReadPairs(argc, argv);
  const slam6d::KdTreeOptions tree = slam6d::bench::ReadTreeOptions(argc, argv);
  slam6d::bench::CompareWithNanoflann(pairs, tree);
  slam6d::bench::CompareWithRoot(pairs, tree);
  return pairs.empty() ? 1 : 0;
}
