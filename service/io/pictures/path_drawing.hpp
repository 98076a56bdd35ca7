// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "service/io/pictures/canvas.hpp"
#include "service/io/pictures/legend.hpp"
#include "service/io/pictures/map_frame.hpp"

namespace qwsm::io {

/// Where the places of a path are on the canvas, but for those within a pixel of the one before: a
/// robot that waits has thousands.
std::vector<Eigen::Vector2d> OnCanvas(const MapFrame& frame,
                                      std::span<const Eigen::Vector2d> path_map_m);

/// Draws an arrow of fixed size where a path begins, pointing where the robot looks.
void DrawStart(MapFrame& frame, const Pose2& T_map_robot);
LegendItem StartItem();

}  // namespace qwsm::io
