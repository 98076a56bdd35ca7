// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>

namespace qwsm::io {

/// Opens a file for reading.
/// @throws std::runtime_error naming the file and the reason.
std::ifstream OpenForReading(const std::filesystem::path& path);

}  // namespace qwsm::io
