// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/network.hpp"

namespace qwsm::test {

/// Maps a log twice: played to a service over DDS as fast as it is answered, and read from its
/// file. Leaves the results in the folders `served` and `mapped`.
inline void MapOverNetworkAndFromFile(const PrivateNetwork& network,
                                      const std::filesystem::path& log,
                                      const std::filesystem::path& folder) {
  Daemon service(network.JoinService({"serve", "--output", folder / "served"}));
  const Outcome replay = network.Run({"replay", log, "--rate", "max"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  const Outcome served = service.End();
  EXPECT_EQ(served.exit_code, 0) << served.errors;

  const Outcome mapped = RunProgram({"map", log, "--output", folder / "mapped"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.errors;
}

}  // namespace qwsm::test
