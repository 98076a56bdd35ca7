// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/mapping/mapping_step.hpp"

namespace qwsm {

/// Notices that a map does not explain any more what it explained a moment ago, or explains it
/// elsewhere, though the robot has hardly moved since: no robot leaves a map from one scan to the
/// next. Where it closes a loop it leaves what it has drawn wrongly, and nothing breaks.
class ViewBreak {
 public:
  /// Takes the answer to the next scan. @return whether the view breaks with it.
  bool Take(const MappingStep& step);
  /// What was seen before was seen elsewhere.
  void Forget() { *this = {}; }
  /// Follows a map that was corrected where the robot is.
  void Move(const Pose2& T_new_old) {
    if (T_map_last_) T_map_last_ = T_new_old * *T_map_last_;
  }

  /// Share of the last scan that the map explained.
  double explained() const { return explained_; }
  /// Whether two scans with this motion between them show nearly the same.
  static bool IsSameView(const Pose2& moved);
  /// Whether so much of a scan is as good as what was explained before the view broke.
  static bool IsAsBefore(double explained, double before);

 private:
  double explained_ = 0.0;
  std::optional<Pose2> T_map_last_;
};

}  // namespace qwsm
