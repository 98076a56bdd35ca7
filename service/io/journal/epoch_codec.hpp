// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm::io {

/// Where a relevant scan of a journal was put by a correction of the map.
struct JournaledPose {
  std::string service;  ///< These three name the scan's entry.
  std::string robot;
  std::uint64_t sequence = 0;
  std::string component{};  ///< Of the map, that the scan is in.
  UncertainPose2 map_robot;
};

/// A correction as one entry of a journal: it is there as a whole or not at all.
std::string EncodeEpoch(std::span<const JournaledPose> poses);
/// Whether the contents of an entry are a correction, not a scan.
bool IsEpoch(std::string_view contents);
/// Reads a correction. @throws BinaryError where there is none.
std::vector<JournaledPose> DecodeEpoch(std::string_view contents);

}  // namespace qwsm::io
