// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/program.hpp"

namespace qwsm::test {

/// Writes the log of a drive through two rooms, and the true poses if they are asked for.
inline void WriteDemoLog(const std::filesystem::path& log, const std::string& truth = "") {
  const std::filesystem::path generator = ProgramPath().parent_path() / "generate_demo_log";
  const std::string command =
      generator.string() + " two-rooms " + log.string() + " " + truth + " 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
}

}  // namespace qwsm::test
