// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "service/dds/robot/match_report_reader.hpp"

namespace qwsm::pipeline {

/// So long a service may leave scans unanswered, or what else it is sent unacknowledged.
inline constexpr auto kPatience = std::chrono::seconds(10);

/// Keeps a publisher of scans from outrunning the service: only so many scans are on their way
/// before one of them is answered.
/// @tparam Kind of the scans: team::Planar or team::Spatial.
template <class Kind>
class BasicAnswerWindow {
 public:
  /// Opens the window.
  /// @param size smaller than the queue of the service, so that nothing is dropped there.
  BasicAnswerWindow(dds::BasicReportReader<Kind>& reports, std::size_t size)
      : reports_(reports), size_(size) {}

  void NoteSent(Timestamp stamp) { unanswered_.push_back(stamp); }

  /// Waits until less than the window's size is unanswered.
  /// @returns false where no answer came for `patience`; what was waited for is then given up.
  bool WaitForRoom(std::chrono::nanoseconds patience) { return WaitFor(size_ - 1, patience); }
  /// Waits until everything is answered.
  bool WaitForAll(std::chrono::nanoseconds patience) { return WaitFor(0, patience); }

  std::size_t answered() const { return answered_; }
  /// Scans the service says it has dropped.
  std::uint64_t dropped() const { return dropped_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool WaitFor(std::size_t most, std::chrono::nanoseconds patience);
  bool Take(std::chrono::nanoseconds timeout);

  dds::BasicReportReader<Kind>& reports_;
  std::size_t size_;
  std::deque<Timestamp> unanswered_;
  std::size_t answered_ = 0;
  std::uint64_t dropped_ = 0;
};

using AnswerWindow = BasicAnswerWindow<team::Planar>;

extern template class BasicAnswerWindow<team::Planar>;
extern template class BasicAnswerWindow<team::Spatial>;

}  // namespace qwsm::pipeline
