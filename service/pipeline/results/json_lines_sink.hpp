// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>

#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Writes one JSON object per scan and line, as soon as it is known: for whoever reads the pipe.
class JsonLinesSink final : public StepSink {
 public:
  explicit JsonLinesSink(std::FILE* stream) : stream_(stream) {}

  /// Writes an answer, or nothing once nobody reads any more: a run has other results.
  /// @throws io::WriteError where it cannot be written for another reason.
  void Take(const TimedStep& timed) override;

 private:
  std::FILE* stream_;
  bool has_reader_ = true;
};

}  // namespace qwsm::pipeline
