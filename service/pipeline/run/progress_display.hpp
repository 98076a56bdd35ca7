// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include "service/pipeline/run/scan_source.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Progress as `map  62 %  4 210/6 790 scans  381 scan/s  ETA 0:07  dropped 0`; what is not known
/// is left out.
std::string ProgressLine(const std::string& task,
                         const SourceProgress& progress,
                         std::chrono::duration<double> elapsed);

/// Simulated time as `504 s simulated  3100 x real time`.
std::string SimulatedTimeText(std::chrono::duration<double> simulated,
                              std::chrono::duration<double> elapsed);

/// The number 4210 as `4 210`.
std::string WithThousands(std::size_t number);

/// Says how progress is shown.
enum class ProgressStyle {
  kNone,
  kLines,  ///< A line every five seconds, for files and dumb terminals.
  kBar,    ///< One line of a terminal, rewritten.
};

/// The style of a stream: kBar where it is a terminal that can rewrite a line (TERM is not "dumb"),
/// else kLines.
ProgressStyle StyleFor(std::FILE* stream);

/// A duration as `0:07`, `12:34` or `1:00:00`.
std::string MinutesAndSeconds(double duration_s);

/// A line about work in progress that is shown now and then.
class StatusLine {
 public:
  using Clock = std::chrono::steady_clock;

  explicit StatusLine(ProgressStyle style);
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { Clear(); }

  /// Shows the text for this time since the beginning, if it is time to show something again.
  void Show(const std::function<std::string(std::chrono::duration<double> elapsed)>& text);
  /// Clears the line of a terminal, so that others can write.
  void Clear();

 private:
  ProgressStyle style_;
  Clock::time_point begin_;
  Clock::time_point next_;
  bool shown_ = false;
};

/// Shows how far a source has come while its scans pass by.
class ProgressDisplay final : public StepSink {
 public:
  ProgressDisplay(std::string task, const ScanSource& source, ProgressStyle style);

  void Take(const TimedStep& timed) override;
  void Clear() { line_.Clear(); }

 private:
  std::string task_;
  const ScanSource& source_;
  StatusLine line_;
};

}  // namespace qwsm::pipeline
