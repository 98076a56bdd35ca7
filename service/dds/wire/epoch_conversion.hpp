// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  /// @param epoch, map_frame: outlive this.
  EpochSample(const team::TeamEpoch& epoch, const std::string& map_frame);
  EpochSample(const EpochSample&) = delete;
  EpochSample& operator=(const EpochSample&) = delete;

  const wire::MapEpoch& sample() const { return sample_; }

 private:
  std::vector<wire::MovedScan> scans_;
  std::vector<wire::MovedRobot> robots_;
  wire::MapEpoch sample_{};
};

/// Says why a sample must not be converted; empty if it may.
std::string_view ObjectionTo(const wire::MapEpoch& sample);
/// The correction of a sample. @pre ObjectionTo(sample).empty()
team::TeamEpoch FromWire(const wire::MapEpoch& sample);

}  // namespace qwsm::dds
