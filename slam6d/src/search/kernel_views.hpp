// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds, poses and trees as the innermost loops see them.
#pragma once

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/geometry/pose3.hpp"
#include "slam6d/src/search/kd_tree_kernel.hpp"

namespace slam6d {

inline KdTreeView ViewOf(const KdTreeLayout& layout) {
  return {.nodes = layout.nodes.data(),
          .limits = layout.limits.data(),
          .blocks = layout.blocks.data(),
          .leaf_of_block = layout.leaf_of_block.data(),
          .origin_m = {layout.origin_m[0], layout.origin_m[1], layout.origin_m[2]},
          .pairs = layout.pairs.data(),
          .cells = layout.cells.data(),
          .float_points = layout.float_points.data()};
}

inline CloudView ViewOf(const PointCloud& cloud) {
  return {.x_m = cloud.x_m(), .y_m = cloud.y_m(), .z_m = cloud.z_m()};
}

inline RigidMotion ViewOf(const Pose3& pose) {
  RigidMotion motion{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.rotation[row][column] = pose.rotation(row, column);
    }
    motion.translation_m[row] = pose.translation_m(row);
  }
  return motion;
}

}  // namespace slam6d
