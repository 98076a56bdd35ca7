// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "service/io/files/binary.hpp"

namespace qwsm::io {

/// Adds a pose to bytes.
void AddPose(BinaryWriter& writer, const Pose2& pose);
void AddPose(BinaryWriter& writer, const UncertainPose2& pose);

/// Reads a pose. @throws BinaryError where there is none, or one that is no position.
Pose2 ReadPose(BinaryReader& reader);
UncertainPose2 ReadUncertainPose(BinaryReader& reader);

}  // namespace qwsm::io
