// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "service/io/rescue/points_of_interest.hpp"
#include "service/team/marks/mark.hpp"

namespace qwsm::pipeline {

/// The marks that are there still, as the RoboCup Rescue League lists them, by their numbers, of
/// which each is given once; times are UTC.
std::vector<io::PointOfInterest> PointsOf(std::span<const team::Mark> marks);

/// Leaves the marks in a folder of results; where there are none, nothing. @throws io::WriteError.
void WriteMarks(const std::filesystem::path& folder, std::span<const team::Mark> marks);

}  // namespace qwsm::pipeline
