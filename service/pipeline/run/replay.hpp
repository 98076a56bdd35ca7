// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/observation.hpp"
#include "service/pipeline/run/scan_source.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// What answers to an observation, such as Mapper::Process() of some mapper.
using Answer = std::function<MappingStep(const Observation&)>;

/// A mapper, and who takes its answers.
struct MappingRun {
  Answer answer;
  std::vector<StepSink*> sinks;
};

/// Why a replay ended.
enum class ReplayEnd { kExhausted, kInterrupted, kSourceFailed };

struct ReplayResult {
  ReplayEnd end = ReplayEnd::kExhausted;
  std::string failure;  ///< Reason that the source gave when it failed.
};

/// Feeds the mappers with all the source has, as fast as they can, and hands every answer to the
/// sinks. Several mappers take turns, scan by scan, so that their times can be compared. A source
/// that fails half way ends the replay but not the program: what came before is worth keeping.
/// Sinks that fail throw.
/// @param stop asked before every scan; when true, the replay ends.
ReplayResult Replay(ScanSource& source,
                    std::span<const MappingRun> runs,
                    const std::function<bool()>& stop);

}  // namespace qwsm::pipeline
