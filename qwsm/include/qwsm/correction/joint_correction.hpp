// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/correction/map_corrector.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// A pose that was answered in a map.
struct StampedAnswer {
  Timestamp stamp{};
  UncertainPose2 map_robot;
};

/// One of the drives that made a map.
struct DriveInMap {
  std::size_t first_scan = 0;  ///< Its first scan among those of the map; they end with the next's.
  std::span<const StampedAnswer> answers;  ///< To all its scans, in the order of their stamps.
};

/// A map that several drives made, and their paths, consistent as a whole.
struct JointCorrection {
  Correction correction;                               ///< `map_robot` is left empty.
  std::vector<RelevantScan> scans;                     ///< At their corrected poses.
  std::vector<std::vector<UncertainPose2>> map_robot;  ///< The path of each drive.
};

/// Corrects a map of which nothing but the scans is known, as MapCorrector corrects that of a
/// single drive: be it one that was saved and that another drive went on with, or that of several
/// robots. The scans of each drive are a chain, loops are looked for among all of them. A map that
/// no drive added to stays as it is.
/// @param drives in the order in which they extended the map; what it held before is older.
JointCorrection CorrectJointly(const ScanMap& map,
                               std::span<const DriveInMap> drives,
                               const MapperOptions& options = {});

}  // namespace qwsm
