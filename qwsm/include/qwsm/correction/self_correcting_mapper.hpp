// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/background_corrector.hpp"
#include "qwsm/correction/node_maker.hpp"
#include "qwsm/mapping/carry_watch.hpp"
#include "qwsm/mapping/lost_robot.hpp"
#include "qwsm/mapping/mapper.hpp"

namespace qwsm {

class AnchoredPath;

/// A correction of the map while the robot drove.
struct MapEpoch {
  Timestamp stamp{};                     ///< Of the first scan that was answered in it.
  std::vector<UncertainPose2> map_node;  ///< Poses of the relevant scans until then, by ScanId.
};

/// What a drive comes to.
struct FinishedDrive {
  Correction correction;
  std::vector<RelevantScan> scans;  ///< At the corrected poses; MapOf() makes them searchable.
};

/// A mapper whose map is corrected while the robot drives: each scan is answered at once, loops
/// are looked for beside, and where they show that the map contradicts itself the answers go on in
/// a corrected one. The same scans give the same answers, whatever the threads do.
///
/// A robot that was carried, or whose log has a gap, is lost as soon as what it sees contradicts
/// what it had mapped before. What it has mapped since then is taken out of the map and becomes a
/// component in a frame of its own; the robot is looked for in the map, and where it is found the
/// component joins the map, as a chain of its own in the pose graph.
class SelfCorrectingMapper {
 public:
  explicit SelfCorrectingMapper(const MapperOptions& options = {}, WorkBeside beside = WorkAtOnce);
  SelfCorrectingMapper(const SelfCorrectingMapper&) = delete;
  SelfCorrectingMapper& operator=(const SelfCorrectingMapper&) = delete;
  ~SelfCorrectingMapper();

  MappingStep Process(const Observation& observation);

  /// The corrections so far.
  std::span<const MapEpoch> epochs() const { return epochs_; }
  const Mapper& mapper() const { return mapper_; }
  /// What is known of the place of a robot that is lost; none of one that is not.
  const PlaceBelief* belief() const { return lost_ ? &lost_->belief() : nullptr; }

  /// How often the robot was lost.
  std::size_t losses() const { return losses_; }

  /// Forgets the points of mapper().map(), when no scan follows: two maps would take twice the
  /// memory. Its scans stay as they were answered.
  void ForgetPoints() { mapper_.ForgetPoints(); }
  /// Corrects path and map once more, in the end. Scans of a robot that was not found are no nodes,
  /// and keep their place beside the last node before.
  Correction Correct();
  /// Corrects path and map once more, and gives up what only more scans or corrections would need,
  /// as two maps would take twice the memory. Left are epochs(), and the scans of mapper().map() as
  /// they were answered. @pre neither scan nor correction follows.
  FinishedDrive Finish();

 private:
  // What was answered since the view broke, or since a robot was found, and may be taken back.
  struct Doubtful {
    std::size_t answers_before = 0;
    std::vector<Observation> observations;
    Pose2 T_map_kept{};             // Of the last one that was kept with its readings.
    std::optional<LostRobot> lost;  // As it was when it was found.
    std::vector<MappingStep> lost_steps;
  };

  MappingStep Map(const Observation& observation);
  void GoOnIn(CorrectedMap corrected, Timestamp stamp);
  void Note(const Observation& observation, const Pose2& T_map_robot, std::size_t answers_before);
  void Take(const MappingStep& step, const std::optional<FoundBeside>& found = {});
  MappingStep Lose();
  void TakeBack(ScanId first);
  void GiveUp();
  void BeginLost(Doubtful& doubtful);
  void TakeUnplaced();
  MappingStep FollowLost(const Observation& observation);
  MappingStep Search(const Observation& observation);
  MappingStep Find(const Observation& observation);
  void Join(std::span<const MappingStep> lost_steps,
            const UncertainPose2& map_local,
            const FoundBeside& local);

  MapperOptions options_;
  Mapper mapper_;
  NodeMaker nodes_;
  BackgroundCorrector corrector_;
  std::unique_ptr<AnchoredPath> path_;
  std::vector<MapEpoch> epochs_;
  CarryWatch watch_;
  Doubtful doubtful_;
  std::optional<LostRobot> lost_;
  std::vector<MappingStep> lost_steps_;  // In the frame of a robot's own, while it is lost.
  std::size_t components_ = 1;
  std::size_t losses_ = 0;
};

}  // namespace qwsm
