// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "service/io/field_reader.hpp"

namespace qwsm::io {

/// Opens a file for reading.
/// @throws std::runtime_error naming the file and the reason.
std::ifstream OpenForReading(const std::filesystem::path& path);

/// @throws std::runtime_error "name:line: fault; expected"
[[noreturn]] void ThrowAtLine(std::string_view name,
                              std::size_t line_number,
                              FieldFault fault,
                              std::string_view expected);

}  // namespace qwsm::io
