// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "service/view/streams/sample.hpp"

namespace qwsm::view {

/// Where somebody is in a stream: behind the sample of this number.
using Cursor = std::uint64_t;

/// What a channel has to send. It keeps its samples once for all who read them: who reads is but a
/// cursor, so that one who hangs costs nothing, and one who is slow misses what is outdated.
class SampleStream {
 public:
  SampleStream() = default;
  SampleStream(const SampleStream&) = delete;
  SampleStream& operator=(const SampleStream&) = delete;
  virtual ~SampleStream() = default;

  /// Where somebody begins who comes now.
  virtual Cursor Begin() const = 0;
  /// The next sample behind the cursor, which moves there; nothing where there is none.
  virtual std::optional<Sample> Next(Cursor& cursor, Clock::time_point now) const = 0;
};

}  // namespace qwsm::view
