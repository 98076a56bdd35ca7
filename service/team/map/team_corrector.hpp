// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/correction/background_corrector.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::team {

/// Corrects a map that many robots make: each robot's scans are a chain of their own, another
/// one where it was set elsewhere, and loops are looked for among the scans of all of them.
class TeamCorrector {
 public:
  explicit TeamCorrector(const MapperOptions& options);

  /// Takes a scan that was added to the map, without looking for loops.
  void Take(const TeamScan& scan);
  /// Looks for loops if it is time to. @return the map to go on in, if it was drawn wrong: all
  /// scans that were taken, in their order.
  std::optional<CorrectedMap> LookIfDue();
  /// Takes over the poses that somebody else found, without waiting for a look that is under way.
  /// @param map_node of all scans that were taken.
  void Adopt(std::span<const UncertainPose2> map_node);

  /// Corrects the map once more, in the end, when nothing follows any more.
  Correction Finish() { return corrector_.Correct(); }

  /// Number of scans that were taken.
  std::size_t size() const { return nodes_; }

 private:
  // The last scan of a robot.
  struct Last {
    std::size_t chain = 0;
    std::size_t node = 0;
    UncertainPose2 map_robot;
    std::optional<Pose2> T_odom_robot;
  };

  void Follow(std::span<const UncertainPose2> map_node);
  ScanMotion MotionSince(const Last& last, const TeamScan& scan) const;

  MotionNoise noise_;
  BackgroundCorrector corrector_;
  // By robot and the component it was in: it may have been lost, and found again.
  std::map<std::pair<std::string, std::string>, Last> last_;
  std::size_t chains_ = 0;
  std::size_t nodes_ = 0;
};

}  // namespace qwsm::team
