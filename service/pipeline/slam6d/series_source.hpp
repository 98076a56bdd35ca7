// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "service/pipeline/run/scan_source.hpp"
#include "service/pipeline/slam6d/scan_series.hpp"
#include "service/team/scans/cloud_scan.hpp"

namespace slam6d::pipeline {

/// The scans of a series as a robot would take them: each at its own time where that is known, else
/// one every `period`, the first at time 0.
class SeriesSource {
 public:
  using Warn = std::function<void(const std::string& problem)>;

  /// Gives a series as observations. @param series outlives this.
  SeriesSource(ScanSeries& series, std::chrono::nanoseconds period, Warn warn);

  /// The observation that Next() will give; null at the end.
  const qwsm::team::CloudObservation* Peek() const { return ahead_ ? &*ahead_ : nullptr; }
  /// The next scan that has points; nothing at the end.
  std::optional<qwsm::team::CloudObservation> Next();
  qwsm::pipeline::SourceProgress progress() const;

 private:
  std::optional<qwsm::team::CloudObservation> Read();

  ScanSeries& series_;
  std::chrono::nanoseconds period_;
  Warn warn_;
  std::size_t read_ = 0;
  std::size_t given_ = 0;
  std::optional<qwsm::team::CloudObservation> ahead_;
};

}  // namespace slam6d::pipeline
