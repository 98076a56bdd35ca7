// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What an answer waits for where the view broke: the last eight relevant scans are taken out of a
// map and of what is to correct it, behind as many others as the argument says.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "qwsm/correction/map_corrector.hpp"
#include "qwsm/correction/node_maker.hpp"
#include "qwsm/mapping/mapper.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::bench {
namespace {

constexpr std::size_t kForgotten = 8;

/// The relevant scans of a robot that drives around offices, on and on.
std::vector<ScanNode> NodesOfADrive(std::size_t count) {
  const test::SimulatedDrive drive =
      test::DriveThrough(test::OfficeLoop(), {.laser = {.beams = 1081}});
  std::vector<ScanNode> nodes;
  while (nodes.size() < count) {
    Mapper mapper;
    NodeMaker maker;
    for (const Observation& observation : drive.observations) {
      if (auto node = maker.Take(mapper.Process(observation))) nodes.push_back(std::move(*node));
    }
  }
  nodes.resize(count);
  return nodes;
}

void ForgetInCorrector(benchmark::State& state) {
  const auto kept = static_cast<std::size_t>(state.range(0));
  const std::vector<ScanNode> nodes = NodesOfADrive(kept + kForgotten);
  MapCorrector corrector;
  for (std::size_t i = 0; i < kept; ++i) corrector.Add(nodes[i]);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = kept; i < nodes.size(); ++i) corrector.Add(nodes[i]);
    state.ResumeTiming();
    corrector.ForgetSince(static_cast<NodeId>(kept));
  }
}
BENCHMARK(ForgetInCorrector)->Unit(benchmark::kMillisecond)->Arg(250)->Arg(1000);

void ForgetInMap(benchmark::State& state) {
  const auto kept = static_cast<std::size_t>(state.range(0));
  const std::vector<ScanNode> nodes = NodesOfADrive(kept + kForgotten);
  Mapper mapper;
  for (std::size_t i = 0; i < kept; ++i) mapper.Extend(nodes[i].scan, nodes[i].map_robot);
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t i = kept; i < nodes.size(); ++i) {
      mapper.Extend(nodes[i].scan, nodes[i].map_robot);
    }
    state.ResumeTiming();
    mapper.ForgetSince(static_cast<ScanId>(kept));
  }
}
BENCHMARK(ForgetInMap)->Unit(benchmark::kMillisecond)->Arg(250)->Arg(1000);

}  // namespace
}  // namespace qwsm::bench
