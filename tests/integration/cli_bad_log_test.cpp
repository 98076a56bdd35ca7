// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Logs that claim, lack or garble what they should hold: a clear message each, and nothing worse.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class BadLog : public ::testing::Test {
 protected:
  /// Five lines of FLASER: what it claims to hold, what it holds, and their stamps.
  void Write(const std::string& count, const std::string& readings) const {
    std::ofstream log(log_);
    for (int i = 0; i < 5; ++i) {
      log << "FLASER " << count << ' ' << readings << " 0 0 0 0 0 0 " << i << " robot " << i
          << '\n';
    }
  }
  Outcome Map() const { return RunProgram({"map", log_, "--output", folder_.path() / "results"}); }

  static std::string Repeated(const std::string& word, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += (i > 0 ? " " : "") + word;
    return text;
  }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "bad.log";
};

TEST_F(BadLog, OfNothingButNansIsReadAndShowsNothing) {
  Write("181", Repeated("nan", 181));
  const Outcome outcome = Map();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.errors.find("bad.log:1: FLASER: readings are negative or not finite"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("no scan shows anything"), std::string::npos) << outcome.errors;
}

TEST_F(BadLog, OfScansWithoutReadingsHasNoScan) {
  Write("0", "");
  const Outcome outcome = Map();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("bad.log:1: FLASER: the count of readings is not"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("there is no scan in"), std::string::npos) << outcome.errors;
}

TEST_F(BadLog, ThatClaimsAMillionReadingsIsNotBelieved) {
  Write("1000000", "1.0 2.0 3.0");
  const Outcome outcome = Map();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("from 1 to 100000"), std::string::npos) << outcome.errors;
}

TEST_F(BadLog, ThatClaimsMoreReadingsThanItHoldsIsNotBelieved) {
  Write("100000", "1.0 2.0 3.0");
  const Outcome outcome = Map();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("bad.log:1: FLASER: "), std::string::npos) << outcome.errors;
}

TEST_F(BadLog, WhoseTimeRunsBackwardsIsMappedInItsOwnOrder) {
  WriteRoomLog(log_, 20);
  // The same lines, stamped from the last to the first.
  std::ifstream forwards(log_);
  std::string text;
  int stamp_s = 100;
  for (std::string line; std::getline(forwards, line); --stamp_s) {
    const std::string robot = " robot ";
    const std::size_t end = line.rfind(robot);
    const std::size_t stamp = line.rfind(' ', end - 1);
    text += line.substr(0, stamp) + ' ' + std::to_string(stamp_s) + robot +
            std::to_string(stamp_s) + '\n';
  }
  forwards.close();
  std::ofstream(log_) << text;
  const Outcome outcome = Map();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("scans          20"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("dead-reckoned  0"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace qwsm::test
