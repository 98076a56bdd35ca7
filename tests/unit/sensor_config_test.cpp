// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The shipped configurations of lasers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "service/config/options_io.hpp"
#include "service/options/program_options.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::config {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(QWSM_SOURCE_DIR) / "configs";

std::set<fs::path> Shipped() {
  std::set<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".yaml") files.insert(entry.path());
  }
  return files;
}

TEST(SensorConfiguration, AllAreValidAndSayWhenToUseThem) {
  EXPECT_EQ(Shipped().size(), 4U);
  for (const fs::path& file : Shipped()) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(
        static_cast<void>(LoadOptions<options::ProgramOptions>({.file = file, .settings = {}})));
    std::ifstream stream(file);
    std::string line;
    for (int i = 0; i < 4; ++i) std::getline(stream, line);  // Below the notice.
    EXPECT_TRUE(line.starts_with("# ")) << line;
  }
}

TEST(SensorConfiguration, TheDefaultOneChangesNothing) {
  const auto options =
      LoadOptions<options::ProgramOptions>({.file = kFolder / "default.yaml", .settings = {}});
  EXPECT_EQ(DumpOptions(options), DumpOptions(options::ProgramOptions{}));
}

TEST(RobotConfiguration, NamesAreThoseThatNamespacesCanHave) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "robots.yaml";
  for (const char* name : {"a b", "/robot1", "a//b"}) {
    std::ofstream(file) << "team: {robots: [{name: \"" << name << "\"}]}\n";
    try {
      static_cast<void>(LoadOptions<options::ProgramOptions>({.file = file, .settings = {}}));
      ADD_FAILURE() << name;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find("team.robots[0].name: must be a namespace"),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace qwsm::config
