// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The report that `qwsm map` and `slam6d register` leave, as a file and in a browser.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/html.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"
#include "tests/support/uos_files.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

std::size_t TimesIn(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
  return count;
}

/// The figures of a metrics.json as the report's data has them: "name":value.
std::vector<std::string> FiguresOf(const fs::path& metrics) {
  std::vector<std::string> figures;
  std::istringstream lines(ReadFile(metrics));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find("\": ");
    if (colon == std::string::npos || line.ends_with('{')) continue;
    if (line.ends_with(',')) line.pop_back();
    const std::size_t begin = line.find('"');
    figures.push_back(line.substr(begin, colon + 2 - begin) + line.substr(colon + 3));
  }
  return figures;
}

void ExpectSound(const fs::path& results) {
  const std::string page = ReadFile(results / "report.html");
  ASSERT_FALSE(page.empty());
  EXPECT_EQ(NestingFault(page), "");
  for (const char* elsewhere : {"http:", "https:", "src=", "@import", "url(", "<link"}) {
    EXPECT_EQ(page.find(elsewhere), std::string::npos)
        << "the page refers to others: " << elsewhere;
  }
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  const std::vector<std::string> figures = FiguresOf(results / "metrics.json");
  EXPECT_GE(figures.size(), 10U);
  for (const std::string& figure : figures) {
    EXPECT_NE(page.find(figure), std::string::npos) << figure;
  }
}

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteRoomLog(log_, 60);
    slam6d::WriteUosDrive(scans_, slam6d::DriveInCircle(4, 2000, 1));
  }
  Outcome Register(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"register", scans_, "--output", results_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Program(arguments, {.program = "slam6d"}).Wait();
  }
  /// The report as a browser has it once its scripts have run.
  std::string InBrowser() const {
    const fs::path dump = folder_.path() / "dump";
    const std::string command =
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --no-first-run --disable-sync "
        "--disable-background-networking --disable-component-update --user-data-dir='" +
        (folder_.path() / "browser").string() + "' --virtual-time-budget=5000 --dump-dom 'file://" +
        (results_ / "report.html").string() + "' >'" + dump.string() + "' 2>/dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return ReadFile(dump);
  }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path scans_ = folder_.path() / "scans";
  fs::path results_ = folder_.path() / "results";
};

TEST_F(Report, OfAMapNeedsNothingElseAndHoldsTheFigures) {
  const Outcome outcome = RunProgram({"map", log_, "--output", results_});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectSound(results_);
}

TEST_F(Report, OfARegistrationNeedsNothingElseAndHoldsTheFigures) {
  const Outcome outcome = Register({});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  ExpectSound(results_);
}

TEST_F(Report, OfALocalizationIsLeftToo) {
  const fs::path map = folder_.path() / "room.qwsm";
  RunProgram({"map", log_, "--output", results_, "--save-map", map});
  RunProgram({"localize", "--map", map, log_, "--output", results_});
  ExpectSound(results_);
}

TEST_F(Report, TakesNoNameOfALogForHtml) {
  const fs::path hostile = folder_.path() / "\"<script>alert(1)<" / "script>&.log";
  fs::create_directories(hostile.parent_path());
  fs::copy_file(log_, hostile);
  RunProgram({"map", hostile, "--output", results_});
  ExpectSound(results_);
  const std::string page = ReadFile(results_ / "report.html");
  EXPECT_EQ(TimesIn("<script", page), 2U) << "the data and our own";
  EXPECT_EQ(TimesIn("</script", page), 2U);
}

TEST_F(Report, IsLeftByAnInterruptedRun) {
  WriteRoomLog(log_, 1000);
  const fs::path pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Program program({"map", log_, "--output", results_, "--json"}, {.output = pipe});
  std::ifstream lines(pipe);
  std::string line;
  std::getline(lines, line);
  program.Signal(SIGINT);
  while (std::getline(lines, line)) continue;
  EXPECT_EQ(program.Wait().exit_code, 130);
  ExpectSound(results_);
  EXPECT_NE(ReadFile(results_ / "report.html").find("\"interrupted\":true"), std::string::npos);
}

TEST_F(Report, AndPicturesAreLeftAwayOnRequest) {
  EXPECT_EQ(RunProgram({"map", log_, "--output", results_, "--no-pictures"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(results_ / "map.yaml")) << "the map is data, too";
  EXPECT_TRUE(fs::exists(results_ / "metrics.json"));
  const auto expect_no_pictures = [&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(results_)) {
      EXPECT_NE(entry.path().extension(), ".png") << entry.path();
      EXPECT_NE(entry.path().extension(), ".html") << entry.path();
    }
  };
  expect_no_pictures();
  EXPECT_EQ(Register({"--no-pictures"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(results_ / "model.ply"));
  expect_no_pictures();
}

TEST_F(Report, DrawsItselfInABrowser) {
  if (!fs::exists("/usr/bin/chromium")) GTEST_SKIP() << "needs the package chromium";
  RunProgram({"map", log_, "--output", results_});
  const std::string map = InBrowser();
  EXPECT_NE(map.find("role=\"alert\" hidden"), std::string::npos) << "a script has failed";
  for (const char* part :
       {"Mean residual", "Worst scans", "Uncertainty of the position", "room.log"}) {
    EXPECT_NE(map.find(part), std::string::npos) << part;
  }
  Register({});
  const std::string model = InBrowser();
  EXPECT_NE(model.find("role=\"alert\" hidden"), std::string::npos) << "a script has failed";
  for (const char* part : {"From the side", "Scans and loops", "scan003"}) {
    EXPECT_NE(model.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace qwsm::test
