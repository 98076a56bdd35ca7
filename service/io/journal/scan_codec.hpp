// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "qwsm/mapping/relevant_scan.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {

/// Relevant scans as bytes, in map files and journals. Their ids are not among them.
void AddScan(BinaryWriter& writer, const RelevantScan& relevant);
/// @throws BinaryError where there is no scan, or one that may not be matched.
RelevantScan ReadScan(BinaryReader& reader);

/// What a journal keeps of a relevant scan.
struct JournaledScan {
  RelevantScan relevant;
  std::optional<Pose2> T_odom_robot;  ///< For the robot to go on from.
};

/// Kind of the journals that keep them; see JournalFile.
inline constexpr std::string_view kScanJournal = "relevant scans of planar lasers, version 1";

std::string EncodeScan(const JournaledScan& scan);
/// @throws BinaryError
JournaledScan DecodeScan(std::string_view bytes);

}  // namespace qwsm::io
