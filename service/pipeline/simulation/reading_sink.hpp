// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/robot.hpp"

namespace qwsm::pipeline {

/// Takes what simulated robots measure, scan by scan: files, a display, a clock to keep pace with.
class ReadingSink {
 public:
  ReadingSink() = default;
  ReadingSink(const ReadingSink&) = delete;
  ReadingSink& operator=(const ReadingSink&) = delete;
  virtual ~ReadingSink() = default;

  virtual void Take(const sim::Reading& reading) = 0;
};

}  // namespace qwsm::pipeline
