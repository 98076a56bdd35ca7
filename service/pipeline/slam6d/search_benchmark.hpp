// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "slam6d/icp/icp.hpp"

namespace slam6d::pipeline {

/// Times of the searches of one registration, at one bucket size.
struct SearchTimes {
  int bucket_size = 0;
  double root_ms = 0.0;
  double cached_ms = 0.0;
  std::vector<double> root_ms_of_iteration;
  std::vector<double> cached_ms_of_iteration;
  double proven_share = 0.0;  ///< Share of the queries answered without touching the tree.
  /// Distances that differ between search from the root and with the cache.
  std::size_t wrong = 0;
};

/// Two scans and where the registration starts.
struct SearchTask {
  PointCloud ref;
  PointCloud cur;
  Pose3 T_ref_cur_guess;
};

/// The experiment of Figure 5 of Nüchter et al. (2007): registers two scans point to point for
/// every bucket size, and times the searches of every iteration from the root and with the cache.
std::vector<SearchTimes> BenchSearch(const SearchTask& task,
                                     std::span<const int> bucket_sizes,
                                     double max_distance_m);

std::string SearchTable(std::span<const SearchTimes> times);

/// Draws the speed-up over bucket size, and the time per iteration at one of them.
/// @throws qwsm::io::WriteError where a picture cannot be written.
void DrawSpeedUp(std::span<const SearchTimes> times, const std::filesystem::path& file);
void DrawIterations(const SearchTimes& times, const std::filesystem::path& file);

}  // namespace slam6d::pipeline
