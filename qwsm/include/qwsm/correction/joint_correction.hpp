// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "qwsm/correction/map_corrector.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// A pose that was answered in a map.
struct StampedAnswer {
  Timestamp stamp{};
  UncertainPose2 map_robot;
};

/// The last drive of those that made a map.
struct LastDrive {
  std::size_t first_scan = 0;              ///< Its first scan among those of the map.
  std::span<const StampedAnswer> answers;  ///< To all its scans, in the order of their stamps.
};

/// A map that several drives made, and the path of the last one, consistent as a whole.
struct JointCorrection {
  Correction correction;  ///< `map_robot` is the path of the last drive.
  ScanMap map;            ///< The scans at their corrected poses.
};

/// Corrects a map of which nothing but the scans is known, such as one that was saved and that
/// another drive went on with, as MapCorrector corrects that of a single drive: the scans of each
/// drive are a chain, loops are looked for among all of them. A map that the last drive added
/// nothing to stays as it is.
JointCorrection CorrectJointly(const ScanMap& map,
                               const LastDrive& last,
                               const MapperOptions& options = {});

}  // namespace qwsm
