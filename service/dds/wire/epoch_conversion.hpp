// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/entities/wire_types.hpp"
#include "service/team/scans/team_epoch.hpp"

/// Corrections of the map on the wire.
namespace qwsm::dds {

/// A correction as it is published.
class EpochSample {
 public:
  /// @param epoch outlives this.
  explicit EpochSample(const team::TeamEpoch& epoch);
  EpochSample(const EpochSample&) = delete;
  EpochSample& operator=(const EpochSample&) = delete;

  const wire::MapEpoch& sample() const { return sample_; }

 private:
  const std::string& FrameOf(const std::string& component);
  std::vector<wire::MovedRobot> RobotsOf(const team::TeamEpoch& epoch);

  std::map<std::string, std::string> frames_;  // By component.
  std::vector<wire::MovedScan> scans_;
  std::vector<wire::MovedRobot> robots_;
  wire::MapEpoch sample_{};
};

/// Says why a sample must not be converted; empty if it may.
std::string_view ObjectionTo(const wire::MapEpoch& sample);
/// The correction of a sample. @pre ObjectionTo(sample).empty()
team::TeamEpoch FromWire(const wire::MapEpoch& sample);

}  // namespace qwsm::dds
