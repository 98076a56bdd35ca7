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

  /// Writes an answer. @throws io::WriteError when nobody reads any more.
  void Take(const TimedStep& timed) override;

 private:
  std::FILE* stream_;
};

}  // namespace qwsm::pipeline
