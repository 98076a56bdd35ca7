// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

#include "service/io/maps/pgm_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

class RosMap : public ::testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
  }

  // The message of the failure to read a map with this description.
  std::string FailureOf(const std::string& yaml) const {
    Write("map.yaml", yaml);
    try {
      ReadRosMap(yaml_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
  fs::path yaml_ = folder_.path() / "map.yaml";
};

constexpr CellState kF = CellState::kFree;
constexpr CellState kO = CellState::kOccupied;
constexpr CellState kU = CellState::kUnknown;

TEST_F(RosMap, IsWrittenWithTheTopRowFirst) {
  WriteRosMap(yaml_,
              {.cell_m = 0.05,
               .origin_map_m = {-12.5, 1.0 / 3.0},
               .width = 3,
               .height = 2,
               .cells = {kF,
                         kO,
                         kU,  // Below.
                         kO,
                         kO,
                         kF}});  // Above.
  EXPECT_EQ(test::ReadFile(yaml_),
            "image: \"map.pgm\"\n"
            "mode: trinary\n"
            "resolution: 0.05\n"
            "origin: [-12.5, 0.3333333333333333, 0]\n"
            "negate: 0\n"
            "occupied_thresh: 0.65\n"
            "free_thresh: 0.196\n");
  const std::string header = "P5\n3 2\n255\n";
  const std::string pixels = {'\0', '\0', '\xFE', '\xFE', '\0', '\xCD'};
  EXPECT_EQ(test::ReadFile(folder_.path() / "map.pgm"), header + pixels);
}

TEST_F(RosMap, ComesBackAsItWas) {
  std::mt19937 random(3);
  OccupancyGrid grid{.cell_m = 0.1 / 3.0,
                     .origin_map_m = {1e5 / 7.0, -2.0},
                     .width = 37,
                     .height = 23,
                     .cells = {}};
  for (int i = 0; i < grid.width * grid.height; ++i) {
    grid.cells.push_back(static_cast<CellState>(random() % 3));
  }
  const fs::path strange = folder_.path() / "a \"strange\" #map.yaml";
  WriteRosMap(strange, grid);
  const OccupancyGrid read = ReadRosMap(strange);
  EXPECT_EQ(read.cell_m, grid.cell_m);
  EXPECT_EQ(read.origin_map_m, grid.origin_map_m);
  EXPECT_EQ(read.width, grid.width);
  EXPECT_EQ(read.height, grid.height);
  EXPECT_EQ(read.cells, grid.cells);
}

TEST_F(RosMap, OfOtherProgramsIsUnderstood) {
  Write("other.pgm", std::string("P5\n# CREATOR: map_saver\n2 1 # cells\n255\n") + "\x01\xCD");
  Write("map.yaml",
        "# saved by hand\n"
        "image: other.pgm   # beside\n"
        "resolution: 0.5\n"
        "origin:\n"
        "- -1.0\n"
        "- 2\n"
        "- 0.0\n"
        "negate: 1\n"
        "occupied_thresh: 0.65\r\n"
        "free_thresh: 0.25\n");
  const OccupancyGrid grid = ReadRosMap(yaml_);
  EXPECT_EQ(grid.cell_m, 0.5);
  EXPECT_EQ(grid.origin_map_m, Eigen::Vector2d(-1.0, 2.0));
  EXPECT_EQ(grid.cells, (std::vector<CellState>{kF, kO}));
}

TEST_F(RosMap, TakesWordsForWhetherItIsNegative) {
  Write("map.pgm", std::string("P5\n2 1\n255\n") + "\x01\xFE");
  const std::string rest =
      "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\nfree_thresh: 0.2\n";
  Write("map.yaml", rest + "negate: false\n");
  EXPECT_EQ(ReadRosMap(yaml_).cells, (std::vector<CellState>{kO, kF}));
  Write("map.yaml", rest + "negate: true\n");
  EXPECT_EQ(ReadRosMap(yaml_).cells, (std::vector<CellState>{kF, kO}));
}

constexpr const char* kRest = "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

TEST_F(RosMap, FailuresNameTheFileAndTheReason) {
  Write("map.pgm", std::string("P5 1 1 255\n") + "\xFE");
  const std::string good = "image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n";
  EXPECT_EQ(FailureOf(good + kRest), "");
  const std::string name = yaml_.string() + ": ";
  EXPECT_EQ(FailureOf("image: map.pgm\n"), name + "the key 'resolution' is missing");
  EXPECT_EQ(FailureOf("image map.pgm\n"), name + "line 1: expected 'key: value'");
  EXPECT_EQ(FailureOf(good + "free_thresh: 0.1\nnegate: 0\noccupied_thresh: high\n"),
            name + "occupied_thresh: expected a number, got 'high'");
  EXPECT_EQ(FailureOf(std::string("resolution: 0.1\nimage: map.pgm\norigin: [0, 0]\n") + kRest),
            name + "origin: expected three numbers, got '[0, 0]'");
  EXPECT_EQ(FailureOf(std::string("resolution: 0.1\nimage: map.pgm\norigin: [0, 0, 1]\n") + kRest),
            name + "origin: a map that is turned cannot be read");
  EXPECT_EQ(FailureOf(std::string("resolution: 0\nimage: map.pgm\norigin: [0, 0, 0]\n") + kRest),
            name + "resolution: must be between 0.0001 and 10000 m");
  EXPECT_EQ(FailureOf("mode: scale\n" + good + kRest),
            name + "mode: only 'trinary' can be read, not 'scale'");
  EXPECT_NE(FailureOf("image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n").find("none.pgm"),
            std::string::npos);
}

TEST_F(RosMap, PicturesThatAreNoneAreRefused) {
  const fs::path pgm = folder_.path() / "map.pgm";
  const auto failure_of = [&](const std::string& bytes) {
    Write("map.pgm", bytes);
    try {
      ReadPgm(pgm);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string name = pgm.string() + ": ";
  const std::string no_pgm =
      "is no binary PGM picture (P5); ImageMagick makes one of others: convert map.png map.pgm";
  EXPECT_EQ(failure_of(""), name + no_pgm);
  EXPECT_EQ(failure_of("P2\n1 1\n255\n0\n"), name + no_pgm);
  EXPECT_EQ(failure_of("P5\n-1 1\n255\n0"), name + "has no size");
  EXPECT_EQ(failure_of("P5\n99999999999 1\n255\n0"), name + "has no size");
  EXPECT_EQ(failure_of("P5\n1 1\n65535\n00"), name + "has not 8 bits per pixel");
  EXPECT_EQ(failure_of("P5\n2 2\n255\n000"), name + "ends early");
  EXPECT_EQ(failure_of("P5\n2000000000 2000000000\n255\n000"), name + "ends early");
}

}  // namespace
}  // namespace qwsm::io
