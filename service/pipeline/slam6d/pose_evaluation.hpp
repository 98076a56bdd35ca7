// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "service/io/clouds/trajectory3_file.hpp"

namespace slam6d::pipeline {

/// Says how a trajectory is laid over the truth before its error is taken.
enum class PoseAlignment {
  kNone,
  kFirst,  ///< The first pose is laid onto the true one: what a registration leaves open.
  kBest,   ///< All positions are laid over the true ones, without scale (Umeyama 1991).
};

/// Absolute trajectory error: root mean square, mean and largest over the poses.
struct PoseErrors {
  std::size_t poses = 0;       ///< Compared ones.
  std::size_t true_poses = 0;  ///< All that there were to compare with.
  double covered = 0.0;        ///< Share of the truth, from its first pose to its last, they span.
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double max_m = 0.0;
  double rmse_rad = 0.0;
  double mean_rad = 0.0;
  double max_rad = 0.0;
};

/// Compares the poses that both trajectories have, by their numbers, or stamps at most 0.01 s apart;
/// where one is only counted and the other has as many, by their order.
/// @throws std::runtime_error where there are none, or too few to align.
PoseErrors Compare(const io::NumberedPoses& estimated,
                   const io::NumberedPoses& true_poses,
                   PoseAlignment alignment);

/// One trajectory and how good it is.
struct NamedErrors {
  std::string name;
  PoseErrors errors;
};

std::string ErrorTable(std::span<const NamedErrors> all);
std::string ErrorJson(std::span<const NamedErrors> all);

}  // namespace slam6d::pipeline
