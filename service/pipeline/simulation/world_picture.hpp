// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "qwsm/metrics/stamped_pose.hpp"
#include "sim/scenery.hpp"

namespace qwsm::pipeline {

/// Where a robot went, and where its odometry believed it to be; both in the world.
struct WorldPaths {
  Trajectory truth;
  Trajectory odometry;
};

/// Draws what stands in a world, as cells of a few centimetres or as small as a map of 16 million
/// cells lets them be, and a robot's paths through it. What can be pushed is drawn where it stood
/// at first; people are not.
/// @throws std::invalid_argument for a name that ends in neither .png nor .svg, io::WriteError
///         where the file cannot be written.
void WriteWorldPicture(const std::filesystem::path& path,
                       const sim::SceneryOptions& scenery,
                       const WorldPaths& paths);

}  // namespace qwsm::pipeline
