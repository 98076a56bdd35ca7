// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

#include "service/io/clouds/scan_points.hpp"

namespace slam6d::io {

/// Cuts the next finite number off the text, past blanks and commas; nothing where there is none.
std::optional<double> NextNumber(std::string_view& text);
std::optional<Eigen::Vector3d> NextTriple(std::string_view& text);

/// Whether the text holds nothing but blanks.
bool IsBlank(std::string_view text);

/// Reads a file of lines 'x y z ...', packed or not; empty lines and those that begin with # are
/// comments, and the first line may be a heading or a number of points.
/// @param to_scanner what a line's numbers are in the scanner's frame, in metres.
/// @throws std::runtime_error naming the file when it cannot be read.
ScanPoints ReadTextPoints(
    const std::filesystem::path& file,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& to_scanner = std::identity());

}  // namespace slam6d::io
