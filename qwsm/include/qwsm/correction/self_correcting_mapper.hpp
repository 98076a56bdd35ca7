// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "qwsm/correction/background_corrector.hpp"
#include "qwsm/correction/node_maker.hpp"
#include "qwsm/mapping/mapper.hpp"

namespace qwsm {

class AnchoredPath;

/// A correction of the map while the robot drove.
struct MapEpoch {
  Timestamp stamp{};                     ///< Of the first scan that was answered in it.
  std::vector<UncertainPose2> map_node;  ///< Poses of the relevant scans until then, by ScanId.
};

/// A mapper whose map is corrected while the robot drives: each scan is answered at once, loops
/// are looked for beside, and where they show that the map contradicts itself the answers go on in
/// a corrected one. The same scans give the same answers, whatever the threads do.
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

  /// Corrects path and map once more, in the end.
  Correction Correct();
  /// Forgets the points of mapper().map(), when no scan follows: two maps would take twice the
  /// memory. Its scans stay as they were answered.
  void ForgetPoints() { mapper_.ForgetPoints(); }
  /// The relevant scans, inserted at these poses. @param map_node as Correct() gives them.
  ScanMap MapAt(std::span<const UncertainPose2> map_node) { return corrector_.MapAt(map_node); }

 private:
  void GoOnIn(CorrectedMap corrected, Timestamp stamp);

  Mapper mapper_;
  NodeMaker nodes_;
  BackgroundCorrector corrector_;
  std::unique_ptr<AnchoredPath> path_;
  std::vector<MapEpoch> epochs_;
};

}  // namespace qwsm
