// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "qwsm/logs/log_record.hpp"

namespace qwsm::io {

/// All that is known of how a robot moved by its own reckoning, in the order of time.
class OdometryTrack {
 public:
  /// Takes a reading; they may come in any order.
  /// @param sequence grows with the place in the recording.
  void Add(const OdometryReading& reading, std::uint64_t sequence);
  /// Puts the readings into order. Call it before At() and reading().
  void Sort();

  bool empty() const { return readings_.empty(); }
  std::size_t size() const { return readings_.size(); }
  const OdometryReading& reading(std::size_t i) const { return readings_[i].reading; }

  /// The odometry of a moment: a reading of that very stamp, or between two. Of several readings
  /// with its stamp, the one recorded last before `sequence` is meant.
  std::optional<Pose2> At(Timestamp stamp, std::uint64_t sequence) const;

 private:
  struct Entry {
    OdometryReading reading;
    std::uint64_t sequence;
  };
  static std::pair<Timestamp, std::uint64_t> OrderOf(const Entry& entry) {
    return {entry.reading.stamp, entry.sequence};
  }

  std::vector<Entry> readings_;
};

}  // namespace qwsm::io
