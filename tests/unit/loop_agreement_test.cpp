// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/src/correction/loop_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "qwsm/correction/node_maker.hpp"
#include "qwsm/src/correction/loop_finder.hpp"
#include "tests/support/bent_drive.hpp"

namespace qwsm::test {
namespace {

constexpr std::size_t kBehind = 3;  // Scans.

/// Two robots of which one follows the other, in the order of their scans.
std::vector<ScanNode> Followed(const std::vector<MappingStep>& steps) {
  std::array<NodeMaker, 2> makers;
  std::vector<ScanNode> nodes;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    nodes.push_back(*makers[0].Take(steps[i]));
    if (i < kBehind) continue;
    nodes.push_back(*makers[1].Take(steps[i - kBehind]));
    nodes.back().robot = 1;
  }
  return nodes;
}

// Loops are found while the submaps that they come from grow: these have other references then.
TEST(LoopAgreement, IsOfWhereLoopsBeganWhileSubmapsGrow) {
  const std::vector<ScanNode> nodes = Followed(Relevant(Drive(OfficeLoop())).steps);
  const MapperOptions options;
  ScanChains chains(options);
  RecentSurfaces recent;
  std::vector<FoundLoop> loops;
  bool has_grown = false;
  for (std::size_t size = 1; size <= 60; ++size) {
    const std::span<const ScanNode> seen = std::span(nodes).first(size);
    chains.Add(seen);
    loops = LoopFinder(options, seen, chains, recent)
                .Find(static_cast<NodeId>(size - 1), AnsweredPoses(seen), {.found = loops});
    has_grown = has_grown || std::ranges::any_of(loops, [&](const FoundLoop& found) {
                  return found.loop.edge.from != chains.submaps()[found.submap].reference();
                });
  }
  EXPECT_TRUE(has_grown);
  ASSERT_GE(loops.size(), 20U);
  // The answers are right, and so are the loops.
  const auto confirmed = std::ranges::count_if(
      loops, [](const FoundLoop& found) { return found.loop.verdict == LoopVerdict::kAccepted; });
  EXPECT_GE(10 * confirmed, 9 * std::ssize(loops));
}

}  // namespace
}  // namespace qwsm::test
