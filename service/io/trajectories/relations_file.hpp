// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>
#include <vector>

#include "qwsm/metrics/relations.hpp"

namespace qwsm::io {

/// Reads relations, one per line: `t1 t2 x y z roll pitch yaw` (seconds, metres, radians); `#`
/// begins a comment. What lies outside the plane is dropped.
/// @throws std::runtime_error with file:line where a line is no relation.
std::vector<Relation> ReadRelations(std::istream& stream, std::string_view name);
std::vector<Relation> ReadRelationsFile(const std::filesystem::path& path);

}  // namespace qwsm::io
