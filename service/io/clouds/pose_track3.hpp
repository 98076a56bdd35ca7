// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace slam6d::io {

/// Where one frame was in another, in the order of time: qwsm::io::OdometryTrack in space.
class PoseTrack3 {
 public:
  /// Takes a pose; they may come in any order. Of two with one stamp the later one counts.
  void Add(qwsm::Timestamp stamp, const Pose3& pose) { poses_.push_back({stamp, pose}); }
  /// Puts the poses into order. Call it before At().
  void Sort();

  std::size_t size() const { return poses_.size(); }

  /// The pose of a moment: as it was told, or between two that are no more than two seconds apart,
  /// or the nearest one if that is no more than 0.2 s away.
  std::optional<Pose3> At(qwsm::Timestamp stamp) const;

 private:
  struct Entry {
    qwsm::Timestamp stamp{};
    Pose3 pose;
  };

  std::vector<Entry> poses_;
};

}  // namespace slam6d::io
