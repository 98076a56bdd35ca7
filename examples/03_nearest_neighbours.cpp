// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The quadtree on its own: stores the points of two scans of a wall, asks for neighbours in three
// ways, and takes one scan out again.
#include <cstdlib>
#include <iostream>

#include "qwsm/search/point_quadtree.hpp"

namespace {

constexpr qwsm::ScanId kFirstScan = 0;
constexpr qwsm::ScanId kSecondScan = 1;

/// A wall along the line y = 2 m, seen every 10 cm by one scan and, half way between, by another.
qwsm::PointQuadtree StoreWall() {
  qwsm::PointQuadtree map;
  for (int i = 0; i < 100; ++i) {
    map.Insert({0.10 * i, 2.0}, kFirstScan);
    map.Insert({0.10 * i + 0.05, 2.0}, kSecondScan);
  }
  return map;
}

}  // namespace

int main() {
  qwsm::PointQuadtree map = StoreWall();
  const Eigen::Vector2d query_m(3.04, 1.9);

  // The nearest point within half a metre; none would be an empty optional. The cursor remembers
  // where the search ended and makes the next one, nearby, quicker.
  qwsm::SearchCursor cursor;
  const auto both_scans = map.Nearest(query_m, 0.5, cursor);
  if (!both_scans) return EXIT_FAILURE;
  std::cout << "nearest of both scans: " << both_scans->position_m.transpose() << " m, of scan "
            << map.Scan(both_scans->id) << '\n';

  int within_reach = 0;
  map.ForEachInRadius(query_m, 0.2, [&](qwsm::PointId, const Eigen::Vector2d&) { ++within_reach; });
  std::cout << "points within 20 cm: " << within_reach << '\n';

  // The map changed, so the cursor is out of date: the search notices and starts from the top.
  map.RemoveScan(kSecondScan);
  const auto first_scan = map.Nearest(query_m, 0.5, cursor);
  if (!first_scan) return EXIT_FAILURE;
  std::cout << "nearest of the first scan: " << first_scan->position_m.transpose() << " m\n";

  const auto [points, merged, nodes, leaves, depth, bytes] = map.Statistics();
  std::cout << points << " points in " << leaves << " leaves, " << bytes / 1024 << " KiB\n";
  return EXIT_SUCCESS;
}
