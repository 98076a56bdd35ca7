// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/run/log_source.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/room_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

TEST(LogSource, TellsOfALogThatBeginsBeforeTheOneBeforeItEnds) {
  const test::TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "room.log";
  test::WriteRoomLog(log, 40);
  std::string told;
  io::LogOptions options;
  options.on_fault = [&told](const std::string& text) { told += text + "\n"; };
  LogSource source({log, log}, options);
  while (source.Next()) continue;
  EXPECT_NE(told.find("room.log: begins 3.9 s before "), std::string::npos) << told;
}

}  // namespace
}  // namespace qwsm::pipeline
