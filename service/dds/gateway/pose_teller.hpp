// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/dds/entities/writer.hpp"

namespace qwsm::dds {

/// A pose with its covariance, as geometry_msgs/PoseWithCovarianceStamped has it.
struct ToldPose {
  Timestamp stamp{};
  std::string frame;
  std::array<double, 7> position_orientation{};  ///< x, y, z in m; quaternion x, y, z, w.
  std::array<double, 36> covariance{};           ///< Of (x, y, z, roll, pitch, yaw); m, rad.
};

/// Tells robots where they are, as an operator does (`initialpose`). Used by one thread.
class PoseTeller {
 public:
  /// Tells nobody yet. @param participant outlives this.
  explicit PoseTeller(const Participant& participant) : participant_(participant) {}

  /// Makes the topic, so that its listeners are known when something is told.
  /// @param topic such as `/robot1/initialpose`. @throws DdsError.
  void Prepare(const std::string& topic);
  /// Publishes what was told; whether it makes sense, the service judges. @throws DdsError.
  void Tell(const std::string& topic, const ToldPose& pose);

 private:
  using PoseWriter = Writer<wire::PoseWithCovarianceStamped>;

  const Participant& participant_;
  std::map<std::string, PoseWriter> writers_;
};

}  // namespace qwsm::dds
