// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The configurations that come with the service, each tried by the program it is for.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/demo_log.hpp"
#include "tests/support/network.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

const fs::path kConfigs = fs::path(QWSM_SOURCE_DIR) / "configs";

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t first = text.find(what);
  EXPECT_NE(first, text.npos) << what;
  for (std::size_t at = first; at != text.npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
  return text;
}

class ShippedConfigs : public ::testing::Test {
 protected:
  void TearDown() override { unsetenv("CYCLONEDDS_URI"); }

  std::string Path(const char* name) const { return folder_.path() / name; }
  /// From now on programs are configured by a file with this text.
  void Configure(const std::string& text) const {
    std::ofstream(Path("cyclone.xml")) << text;
    setenv("CYCLONEDDS_URI", ("file://" + Path("cyclone.xml")).c_str(), 1);
  }

  TemporaryFolder folder_;
  PrivateNetwork network_;
};

TEST_F(ShippedConfigs, OfLoopbackAndOfTheWiredNetworkAreUnderstood) {
  Configure(ReadFile(kConfigs / "dds/loopback.xml"));
  const std::string tag = "network.tag=" + network_.tag();
  const Outcome loopback = RunProgram({"echo", "--duration", "0.1", "--set", tag});
  EXPECT_EQ(loopback.exit_code, 0) << loopback.errors;
  EXPECT_EQ(loopback.errors, "");

  Configure(Replaced(ReadFile(kConfigs / "dds/wired-team.xml"),
                     "<NetworkInterface name=\"eth0\"/>",
                     "<NetworkInterface name=\"lo\" multicast=\"true\"/>"));
  const Outcome wired = RunProgram({"echo", "--duration", "0.1", "--set", tag});
  EXPECT_EQ(wired.exit_code, 0) << wired.errors;
}

TEST_F(ShippedConfigs, WithAMistakeAreRefusedByName) {
  Configure(Replaced(ReadFile(kConfigs / "dds/loopback.xml"), "AllowMulticast", "AllowMultycast"));
  const Outcome echo = RunProgram({"echo", "--duration", "0.1"});
  EXPECT_EQ(echo.exit_code, 2);
  EXPECT_NE(echo.errors.find("AllowMultycast"), std::string::npos) << echo.errors;
  EXPECT_NE(echo.errors.find("CYCLONEDDS_URI"), std::string::npos) << echo.errors;
}

TEST_F(ShippedConfigs, OfSecurityLetMembersInAndKeepOthersOut) {
  if (std::system("command -v openssl >/dev/null") != 0) GTEST_SKIP() << "no openssl";
  const std::string keys = Path("keys");
  const std::string make_keys = kConfigs / "dds/make_keys";
  ASSERT_EQ(std::system((make_keys + " " + keys + " 2>/dev/null").c_str()), 0);
  const std::string log = Path("two-rooms.log");
  WriteDemoLog(log);

  Configure(Replaced(ReadFile(kConfigs / "dds/security.xml"), "/etc/qwsm/security", keys));
  Daemon service(network_.JoinService({"serve", "--verbose"}));
  ASSERT_TRUE(service.WaitUntilItSays("serving as")) << service.ErrorsSoFar();
  const Outcome member = network_.Run({"replay", log, "--rate", "max"});
  EXPECT_EQ(member.exit_code, 0) << member.errors;
  EXPECT_NE(member.output.find("dropped by the service 0"), std::string::npos) << member.output;

  unsetenv("CYCLONEDDS_URI");
  const Outcome stranger = network_.Run({"replay", log, "--rate", "max", "--wait", "2"});
  EXPECT_EQ(stranger.exit_code, 1);
  EXPECT_NE(stranger.errors.find("nobody listens"), std::string::npos) << stranger.errors;
}

TEST_F(ShippedConfigs, OfSystemdAreWhatSystemdUnderstands) {
  if (std::system("command -v systemd-analyze >/dev/null") != 0) GTEST_SKIP() << "no systemd";
  const std::string unit = Path("qwsm.service");
  std::ofstream(unit) << Replaced(
      ReadFile(kConfigs / "systemd/qwsm.service"), "/usr/bin/qwsm", ProgramPath());
  EXPECT_EQ(
      std::system(
          ("systemd-analyze verify --man=no " + unit + " >" + Path("said") + " 2>&1").c_str()),
      0);
  EXPECT_EQ(ReadFile(Path("said")), "");
}

}  // namespace
}  // namespace qwsm::test
