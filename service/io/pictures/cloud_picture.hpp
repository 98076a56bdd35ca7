// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d::io {

/// Says from where a model is looked at.
enum class CloudView {
  kTop,   ///< x to the right, y up.
  kSide,  ///< x to the right, z up.
};

/// The part of a view that is drawn, in metres.
struct CloudWindow {
  Eigen::Vector2d low_m;
  Eigen::Vector2d high_m;
};

/// A model and the way through it, in one frame.
struct CloudScene {
  const PointCloud& points;
  std::vector<Eigen::Vector3d> path_m;
  std::string title;
};

/// A window that shows all of the points but the few that lie far off, and the whole path.
CloudWindow WindowOf(const CloudScene& scene, CloudView view);

/// Draws the points, darker where many lie behind each other, and the path over them. The file is a
/// PNG or an SVG, as its name ends.
/// @throws qwsm::io::WriteError where it cannot be written.
void WriteCloudPicture(const std::filesystem::path& file,
                       const CloudScene& scene,
                       CloudView view,
                       const CloudWindow& window);

}  // namespace slam6d::io
