// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "sim/simulation.hpp"

namespace qwsm::test {

/// A pose as found and as it was, both in the frame of the map.
struct FoundPose {
  Timestamp stamp{};
  Pose2 T_map_true;
  UncertainPose2 map_robot;
};

/// Root of the mean squared distance between found and true positions, aligned as well as can be.
double AteRmse_m(std::span<const FoundPose> poses);

/// The first robot of a scenario, mapped while it drives. Of several answers for one moment, as two
/// lasers get, the last counts: it is by all that was seen.
class MappedDrive {
 public:
  explicit MappedDrive(const sim::ScenarioOptions& scenario, const MapperOptions& options = {});

  const std::vector<FoundPose>& poses() const { return poses_; }
  const ScanMap& map() const { return mapper_.map(); }
  const Pose2& T_world_map() const { return T_world_map_; }
  const sim::SceneryOptions& scenery() const { return simulation_.scenery(); }

  double AteRmse_m() const { return test::AteRmse_m(poses_); }

 private:
  sim::Simulation simulation_;
  Mapper mapper_;
  Pose2 T_world_map_;
  std::vector<FoundPose> poses_;
};

}  // namespace qwsm::test
