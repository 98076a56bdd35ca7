// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/replay.hpp"

#include <chrono>
#include <optional>

#include "qwsm/logs/log_reader.hpp"
#include "service/pipeline/run/thread_time.hpp"

namespace qwsm::pipeline {
namespace {

void Feed(const Observation& observation, const MappingRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::nanoseconds worked_before = WorkedByThread();
  TimedStep timed{.step = run.answer(observation),
                  .T_odom_robot = observation.T_odom_robot,
                  .scan = &observation.scan};
  timed.worked = WorkedByThread() - worked_before;
  timed.duration = std::chrono::steady_clock::now() - start;
  for (StepSink* sink : run.sinks) sink->Take(timed);
}

}  // namespace

ReplayResult Replay(ScanSource& source,
                    std::span<const MappingRun> runs,
                    const std::function<bool()>& stop) {
  while (!stop()) {
    std::optional<Observation> observation;
    try {
      observation = source.Next();
    } catch (const io::LogError& error) {
      return {.end = ReplayEnd::kSourceFailed, .failure = error.what()};
    }
    if (!observation) return {.end = ReplayEnd::kExhausted, .failure = {}};
    for (const MappingRun& run : runs) Feed(*observation, run);
  }
  return {.end = ReplayEnd::kInterrupted, .failure = {}};
}

}  // namespace qwsm::pipeline
