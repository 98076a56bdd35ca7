// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "service/view/streams/sample_stream.hpp"

namespace qwsm::view {

/// What whoever comes late gets of what was before, however old it is.
enum class ForLateComers : std::uint8_t { kNothing, kLast, kAll };

/// How long samples are worth sending, and to whom.
struct RecencyOptions {
  std::size_t depth = 32;  ///< So many are kept.
  ForLateComers for_late_comers = ForLateComers::kNothing;
  /// What is older is left out where there is something newer, unless all are for late comers.
  Clock::duration outdated = std::chrono::milliseconds(100);
};

/// The last samples of a topic.
class RecentSamples final : public SampleStream {
 public:
  explicit RecentSamples(const RecencyOptions& options) : options_(options) {}

  void Add(Sample sample);

  Cursor Begin() const override;
  std::optional<Sample> Next(Cursor& cursor, Clock::time_point now) const override;

 private:
  Cursor first() const { return end_ - samples_.size(); }

  RecencyOptions options_;
  std::deque<Sample> samples_;
  Cursor end_ = 0;  // Number of the sample that comes next.
};

}  // namespace qwsm::view
