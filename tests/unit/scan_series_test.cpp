// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/scan_series.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace slam6d::pipeline {
namespace {

namespace fs = std::filesystem;

Pose3 AtX(double x_m) { return {.translation_m = {x_m, 0.0, 0.0}}; }

class ScansInFiles : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name) {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "1 2 3\n4 5 6\n7 8 8\n";
    return file;
  }

  /// The scans that arguments mean, started from poses whose x is their number.
  static std::vector<LoadedScan> Load(const std::vector<fs::path>& arguments) {
    io::NumberedPoses starts;
    for (int number = 0; number < 20; ++number) starts[number] = AtX(number);
    ScanSeries series(FindScans(arguments, {}, [](const std::string&) {}), starts, {});
    std::vector<LoadedScan> scans;
    while (std::optional<LoadedScan> scan = series.Next()) scans.push_back(std::move(*scan));
    return scans;
  }

  static void ExpectNumbers(const std::vector<LoadedScan>& scans,
                            const std::vector<std::size_t>& numbers) {
    ASSERT_EQ(scans.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(scans[i].number, numbers[i]);
      EXPECT_EQ(scans[i].T_odom_scan.translation_m.x(), static_cast<double>(numbers[i]));
    }
  }

  qwsm::test::TemporaryFolder folder_;
};

TEST_F(ScansInFiles, HaveTheNumbersAtTheEndsOfTheirNames) {
  for (const char* name : {"d/scan000.3d", "d/scan002.3d", "d/scan003.3d", "d/scan010.3d"}) {
    Write(name);
  }
  ExpectNumbers(Load({folder_.path() / "d"}), {0, 2, 3, 10});
}

TEST_F(ScansInFiles, AreCountedWhereTheirNamesDoNotNumberThem) {
  ExpectNumbers(Load({Write("left.xyz"), Write("right.xyz")}), {0, 1});
  ExpectNumbers(Load({Write("a7.xyz"), Write("b9.xyz")}), {0, 1});
  ExpectNumbers(Load({Write("1305031102.175304.xyz"), Write("1305031103.205304.xyz")}), {0, 1});
  ExpectNumbers(Load({Write("1305031102175304.xyz"), Write("1305031103205304.xyz")}), {0, 1});
}

TEST_F(ScansInFiles, OfOneNameAreCalledByTheirPlace) {
  const std::vector<LoadedScan> scans =
      Load({Write("a/scan004.xyz"), Write("b/scan004.xyz"), Write("a/scan005.xyz")});
  ExpectNumbers(scans, {0, 1, 2});
  EXPECT_EQ(scans[1].name, "scan001");
  EXPECT_EQ(scans[2].name, "scan002");
}

TEST_F(ScansInFiles, OfAFolderAreNotTakenTwiceWherePackedOnesLieBesideThem) {
  for (const char* name : {"d/scan000.3d", "d/scan001.3d", "d/scan001.3d.gz"}) Write(name);
  try {
    Load({folder_.path() / "d"});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("twice, scan001.3d and scan001.3d.gz"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(ScansInFiles, AreFoundBelowAFolderThatIsCalledLikeATextAndNowhereElse) {
  Write("my.txt_scans/scan000.xyz");
  Write("my.txt_scans/notes.txt");
  EXPECT_EQ(Load({folder_.path() / "my.txt_scans"}).size(), 1U);
  try {
    Load({folder_.path() / "nowhere"});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no such file or folder"), std::string::npos);
  }
}

}  // namespace
}  // namespace slam6d::pipeline
