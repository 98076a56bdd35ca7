// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm export` as its users run it, on whatever holds a map.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/team/marks/mark_book.hpp"
#include "service/team/marks/mark_journal.hpp"
#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class ExportCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteRoomLog(log_, 60);
    RunProgram({"map", log_, "-o", results_, "--save-map", saved_, "--no-pictures"});
  }
  Outcome Export(const fs::path& source, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"export", source, "--geotiff", folder_.path() / "rescue"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  }
  /// The relevant scans of the saved map as a service's journal has them.
  fs::path Journal() const {
    const fs::path file = folder_.path() / "team.journal";
    const ScanMap map = io::LoadMap(saved_);
    std::vector<io::JournalEntry> entries;
    for (const RelevantScan& scan : map.scans()) {
      entries.push_back({.service = "base",
                         .robot = "robot1",
                         .sequence = entries.size(),
                         .stamp = scan.scan.stamp,
                         .contents = io::EncodeScan({.relevant = scan, .T_odom_robot = {}})});
    }
    io::JournalFile::Continue(file, io::kScanJournal, "base").Append(entries);
    return file;
  }
  std::string Left(const std::string& ending) const {
    return ReadFile(folder_.path() / ("rescue" + ending));
  }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path results_ = folder_.path() / "results";
  fs::path saved_ = folder_.path() / "room.qwsm";
};

TEST_F(ExportCommand, GivesTheSameMapOfAllThatHoldsIt) {
  std::string first;
  for (const fs::path& source : {saved_, Journal(), results_, results_ / "map.yaml"}) {
    SCOPED_TRACE(source);
    const Outcome outcome = Export(source);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_TRUE(Left(".tif").starts_with("II*") || Left(".tif").starts_with("MM"));
    if (first.empty()) first = Left(".tfw");
    EXPECT_EQ(Left(".tfw"), first);
    EXPECT_TRUE(Left("_pois.csv").starts_with("\"pois\"\n\"1.2\"\n"));
  }
}

TEST_F(ExportCommand, RefusesFilesWithoutAName) {
  for (const std::string& name : {std::string(), folder_.path().string() + "/"}) {
    const Outcome outcome = RunProgram({"export", results_, "--geotiff", name});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find("--geotiff needs a name"), std::string::npos) << outcome.errors;
  }
}

TEST_F(ExportCommand, MarksOfAJournalAreOnTheMapsThatAreSavedOfIt) {
  const fs::path journal = Journal();
  const RelevantScan scan = io::LoadMap(saved_).scans().back();
  team::MarkBook book;
  book.Place(std::vector<team::ScanPlace>{
      {.robot = "robot1", .stamp = scan.scan.stamp, .T_map_robot = scan.map_robot.T_a_b}});
  const team::Mark mark =
      book.Completed({.id = "m1", .kind = "victim", .text = "Anna", .p_map_m = {1.0, 0.5}});
  team::MarkJournal(journal, [](const std::string& text) { ADD_FAILURE() << text; }).Keep({mark});
  const auto lists_anna = [&](const fs::path& source) {
    EXPECT_EQ(Export(source).exit_code, 0);
    // Marks go with a map that is corrected, here by a millimetre.
    const std::regex anna(R"("Anna",(1\.00|0\.99).,0\.(50|49).,0\.000,1,T,victim)");
    return std::regex_search(Left("_pois.csv"), anna);
  };
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--no-pictures", "--force", "-o", results_});
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  };
  EXPECT_TRUE(lists_anna(journal));
  const fs::path first = folder_.path() / "first.qwsm";
  run({"map", journal, "--save-map", first});
  EXPECT_TRUE(lists_anna(first));
  EXPECT_TRUE(lists_anna(results_));
  const fs::path second = folder_.path() / "second.qwsm";
  run({"map", log_, "--continue", first, "--save-map", second});
  EXPECT_TRUE(lists_anna(second));
  EXPECT_TRUE(lists_anna(results_));
  fs::remove_all(results_);
  run({"localize", "--map", second, log_});
  EXPECT_TRUE(lists_anna(results_));
}

TEST_F(ExportCommand, ListsTheMarksAndTheMission) {
  const fs::path marks = folder_.path() / "marks.csv";
  std::ofstream(marks) << "x,y,type\n1,0.5,victim\n500,0,qr\n";
  const Outcome outcome = Export(
      results_,
      {"--pois", marks, "--team", "Q-WSM", "--mission", "Final", "--start", "2026-07-04 10:15:00"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("point 2 at 500.00 0.00 lies outside"), std::string::npos);
  EXPECT_EQ(Left("_pois.csv"),
            "\"pois\"\n\"1.2\"\n\"Q-WSM\"\n\"\"\n\"2026-07-04\"\n\"10:15:00\"\n\"Final\"\n\n"
            "id,time,text,x,y,z,robot,mode,type\n"
            "1,,\"\",1.000,0.500,0.000,1,T,victim\n"
            "2,,\"\",500.000,0.000,0.000,1,T,qr\n");
}

TEST_F(ExportCommand, TellsWhatIsWrong) {
  const auto expect_told = [](const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
  };
  const fs::path marks = folder_.path() / "marks.csv";
  std::ofstream(marks) << "x,y,type\none,0.5,victim\n";
  expect_told(Export(log_), "room.log: is none of a folder of results");
  expect_told(Export(folder_.path()), "holds no map.yaml");
  expect_told(Export(folder_.path() / "none"), "there is no such file");
  expect_told(Export(results_, {"--pois", marks}), "marks.csv:2: x is to be a number");
  expect_told(Export(results_, {"--start", "yesterday"}), "a day and a time");
  expect_told(Export(results_, {"--live"}), "either a SOURCE or --live");
  EXPECT_FALSE(fs::exists(folder_.path() / "rescue.tif"));
  const Outcome unwritable = RunProgram({"export", results_, "--geotiff", "/nowhere/rescue"});
  EXPECT_EQ(unwritable.exit_code, 3) << unwritable.errors;
}

TEST_F(ExportCommand, IsReadByGdal) {
  if (std::system("gdalinfo --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "needs gdalinfo, of the package gdal-bin";
  }
  Export(results_);
  const fs::path told = folder_.path() / "told";
  const std::string command =
      "gdalinfo '" + (folder_.path() / "rescue.tif").string() + "' >'" + told.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string info = ReadFile(told);
  for (const char* fact : {"GTiff/GeoTIFF",
                           "Pixel Size = (0.05",
                           "COMPRESSION=LZW",
                           "\"metre\"",
                           "AREA_OR_POINT=Area"}) {
    EXPECT_NE(info.find(fact), std::string::npos) << fact << "\n" << info;
  }
}

}  // namespace
}  // namespace qwsm::test
