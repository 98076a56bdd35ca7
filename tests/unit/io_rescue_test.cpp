// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Maps for rescue teams, against the colours and forms of the RoboCup Rescue rules.
#include <gtest/gtest.h>
#include <tiffio.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "service/io/files/atomic_file.hpp"
#include "service/io/rescue/geotiff_file.hpp"
#include "service/io/rescue/points_of_interest.hpp"
#include "service/io/rescue/rescue_map.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kDark = 0xE2E2E3;
constexpr std::uint32_t kLight = 0xEDEDEE;
constexpr std::uint32_t kFree = 0xFFFFFF;
constexpr std::uint32_t kGridLine = 0xBEBEBF;
constexpr std::uint32_t kWall = 0x002878;
constexpr std::uint32_t kPath = 0x78008C;
constexpr std::uint32_t kStart = 0xFFC800;
constexpr std::uint32_t kVictim = 0xF00A0A;
constexpr std::uint32_t kHazard = 0xFF641E;
constexpr std::uint32_t kObject = 0x0A0AF0;
constexpr std::uint32_t kLegendInk = 0x00328C;

/// A free floor of 8 x 6 m with a wall at its right edge, at cells of 5 cm, whose lower left corner
/// is at (-1, -2); unknown cells, 1 m wide, around it.
OccupancyGrid Floor() {
  OccupancyGrid grid{
      .cell_m = 0.05, .origin_map_m = {-2.0, -3.0}, .width = 200, .height = 160, .cells = {}};
  grid.cells.assign(std::size_t{200} * 160, CellState::kUnknown);
  for (int y = 20; y < 140; ++y) {
    for (int x = 20; x < 180; ++x) {
      grid.cells[grid.Index(x, y)] = x == 179 ? CellState::kOccupied : CellState::kFree;
    }
  }
  return grid;
}

PointOfInterest Mark(const std::string& id, const std::string& type, double x_m, double y_m) {
  PointOfInterest point;
  point.id = id;
  point.type = type;
  point.p_map_m = {x_m, y_m, 0.0};
  return point;
}

class RescueMap : public ::testing::Test {
 protected:
  GeoPicture Draw(int px_per_cell) const {
    return DrawRescueMap({.grid = grid_,
                          .paths = {{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 3.0, 0.0}}},
                          .points = {Mark("1", "victim", 4.0, 1.0),
                                     Mark("2", "hazmat", 5.0, 2.0),
                                     Mark("3", "qr", 5.0, 3.0)},
                          .name = "floor.tif",
                          .px_per_cell = px_per_cell});
  }
  GeoPicture DrawSearched(double searched_m) const {
    std::vector<Pose2> path;
    for (int i = 0; i < 20; ++i) path.push_back({0.1 * i, 0.0, 0.0});
    return DrawRescueMap({.grid = grid_,
                          .paths = {path, {{5.5, 2.0, 0.0}}},
                          .points = {},
                          .name = "floor.tif",
                          .searched_m = searched_m});
  }
  static std::uint32_t At(const GeoPicture& picture, double x_m, double y_m) {
    const Eigen::Vector2d px = picture.ToPixel({x_m, y_m});
    const auto row = static_cast<std::size_t>(px.y());
    return picture.image.pixels[row * static_cast<std::size_t>(picture.image.width_px) +
                                static_cast<std::size_t>(px.x())];
  }

  OccupancyGrid grid_ = Floor();
};

TEST_F(RescueMap, WhatWasSearchedIsGreenAndGreenerTheOftener) {
  grid_.cells[grid_.Index(150, 105)] =
      CellState::kOccupied;  // At (5.5, 2.25): what is behind is hidden.
  const GeoPicture picture = DrawSearched(1.0);
  EXPECT_EQ(At(picture, 1.02, 0.42), 0x82E682U);
  EXPECT_EQ(At(picture, 6.02, 2.02), 0xB4E6B4U);
  EXPECT_EQ(At(picture, 5.52, 2.52), kFree);
  EXPECT_EQ(At(picture, 4.22, -1.22), kFree);
  EXPECT_EQ(At(DrawSearched(0.0), 1.02, 0.42), kFree);
}

TEST_F(RescueMap, HasThreeMetresAtTheTopLeftAndOneAtTheBottomRight) {
  const GeoPicture picture = Draw(1);
  EXPECT_DOUBLE_EQ(picture.pixel_m, 0.05);
  EXPECT_NEAR(picture.top_left_map_m.x(), -1.0 - 3.0, 1e-9);
  EXPECT_NEAR(picture.top_left_map_m.y(), 4.0 + 3.0, 1e-9);
  EXPECT_EQ(picture.image.width_px, (3 + 8 + 1) * 20);
  EXPECT_EQ(picture.image.height_px, (3 + 6 + 1) * 20);
}

TEST_F(RescueMap, HasTheColoursOfTheRules) {
  for (const int px_per_cell : {1, 3}) {
    SCOPED_TRACE(px_per_cell);
    const GeoPicture picture = Draw(px_per_cell);
    const double half_px_m = 0.5 * picture.pixel_m;
    EXPECT_EQ(At(picture, 3.3, -1.3), kFree);
    EXPECT_EQ(At(picture, 7.0 - half_px_m, 1.3), kWall);
    EXPECT_EQ(At(picture, 1.0, half_px_m), kPath);
    EXPECT_EQ(At(picture, 0.075, half_px_m), kStart);
    EXPECT_EQ(At(picture, 4.0 + 0.14, 1.0), kVictim) << "within the disc of 0.35 m";
    EXPECT_EQ(At(picture, 4.0 + 0.23, 1.23), kFree) << "outside of it";
    EXPECT_EQ(At(picture, 5.0 + half_px_m, 2.125), kHazard) << "within the diamond";
    EXPECT_EQ(At(picture, 5.0 + 0.17, 2.17), kFree) << "beside its edge";
    EXPECT_EQ(At(picture, 5.0 + 0.14, 3.0), kObject);
  }
}

TEST_F(RescueMap, IsChequeredByTheMetreWhereNothingIsKnown) {
  const GeoPicture picture = Draw(1);
  EXPECT_EQ(At(picture, 0.5, 5.5), kLight);
  EXPECT_EQ(At(picture, 1.5, 5.5), kDark);
  EXPECT_EQ(At(picture, 1.5, 4.5), kLight);
  EXPECT_EQ(At(picture, -1.5, -0.5), kLight) << "left of the floor";
  EXPECT_EQ(At(picture, 1.01, 5.99), kDark) << "aligned to the map";
  EXPECT_EQ(At(picture, 0.99, 5.99), kLight);
}

TEST_F(RescueMap, HasAGridOfHalfAMetreOnePixelWideOnWhatIsFree) {
  const GeoPicture picture = Draw(1);
  int lines = 0;
  for (double x_m = -0.975; x_m < 6.9; x_m += 0.05) {
    if (At(picture, x_m, -1.3) == kGridLine) ++lines;
  }
  EXPECT_EQ(lines, 15) << "between 8 m of walls";
  for (double y_m = 4.1; y_m < 6.9; y_m += 0.05) EXPECT_NE(At(picture, 5.3, y_m), kGridLine);
}

TEST_F(RescueMap, NumbersItsMarksInWhite) {
  const GeoPicture picture = Draw(3);
  int white = 0;
  for (double x_m = -0.1; x_m < 0.1; x_m += 0.01) {
    for (double y_m = -0.1; y_m < 0.1; y_m += 0.01) {
      white += At(picture, 4.0 + x_m, 1.0 + y_m) == kFree ? 1 : 0;
    }
  }
  EXPECT_GT(white, 10);
}

TEST_F(RescueMap, SaysNameScaleAndAxesAtTheTopLeft) {
  const GeoPicture picture = Draw(1);
  int ink = 0;
  for (double x_m = -3.975; x_m < -1.0; x_m += 0.05) {
    for (double y_m = 4.025; y_m < 7.0; y_m += 0.05) ink += At(picture, x_m, y_m) == kLegendInk;
  }
  EXPECT_GT(ink, 55) << "lines of three metres in all; letters are smoothed";
  int scale = 0;
  for (double y_m = 4.025; y_m < 7.0; y_m += 0.05) scale += At(picture, -3.475, y_m) == kLegendInk;
  EXPECT_NEAR(scale, 20, 2) << "a metre";
}

TEST_F(RescueMap, IsDrawnWhateverTheBytesOfANumber) {
  const GeoPicture picture =
      DrawRescueMap({.grid = grid_,
                     .paths = {},
                     .points = {Mark("\xFF\xE9", "victim", 4.0, 1.0), Mark("2", "qr", 5.0, 3.0)},
                     .name = "\xC3\x28.tif"});
  EXPECT_EQ(At(picture, 5.0 + 0.14, 3.0), kObject) << "what comes after it is drawn, too";
}

TEST_F(RescueMap, OfNothingKnownIsRefused) {
  grid_.cells.assign(grid_.cells.size(), CellState::kUnknown);
  EXPECT_THROW(Draw(1), std::runtime_error);
}

TEST_F(RescueMap, ComesBackFromTheFileAtItsPlace) {
  const test::TemporaryFolder folder;
  const GeoPicture picture = Draw(1);
  WriteGeoTiff(folder.path() / "floor.tif", picture);
  TIFF* const tiff = TIFFOpen((folder.path() / "floor.tif").c_str(), "r");
  ASSERT_NE(tiff, nullptr);
  std::uint16_t compression = 0;
  TIFFGetField(tiff, TIFFTAG_COMPRESSION, &compression);
  EXPECT_EQ(compression, COMPRESSION_LZW);
  // Libtiff gives tags that it does not know with a count before the values.
  const auto numbers = [&](std::uint32_t tag) {
    std::uint32_t count = 0;
    const double* values = nullptr;
    TIFFGetField(tiff, tag, &count, &values);
    return std::vector<double>(values, values + count);
  };
  EXPECT_EQ(numbers(33550), (std::vector<double>{0.05, 0.05, 0.0}));
  const std::vector<double> tie_point = numbers(33922);
  ASSERT_EQ(tie_point.size(), 6U);
  EXPECT_NEAR(tie_point[3], -4.0, 1e-9);
  EXPECT_NEAR(tie_point[4], 7.0, 1e-9);

  const auto width = static_cast<std::size_t>(picture.image.width_px);
  std::vector<std::uint32_t> pixels(picture.image.pixels.size());
  ASSERT_EQ(TIFFReadRGBAImageOriented(tiff,
                                      static_cast<std::uint32_t>(width),
                                      static_cast<std::uint32_t>(picture.image.height_px),
                                      pixels.data(),
                                      ORIENTATION_TOPLEFT,
                                      1),
            1);
  TIFFClose(tiff);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint32_t pixel =
        TIFFGetR(pixels[i]) << 16U | TIFFGetG(pixels[i]) << 8U | TIFFGetB(pixels[i]);
    ASSERT_EQ(pixel, picture.image.pixels[i]) << i % width << ' ' << i / width;
  }
}

TEST_F(RescueMap, HasAWorldFileOfTheFirstPixelsCentre) {
  const test::TemporaryFolder folder;
  WriteWorldFile(folder.path() / "floor.tfw", Draw(1));
  EXPECT_EQ(test::ReadFile(folder.path() / "floor.tfw"),
            "0.0500000000\n0.0000000000\n0.0000000000\n-0.0500000000\n"
            "-3.9750000000\n6.9750000000\n");
}

TEST_F(RescueMap, ThatCannotBeWrittenIsAFault) {
  EXPECT_THROW(WriteGeoTiff("/nowhere/floor.tif", Draw(1)), WriteError);
  if (fs::exists("/dev/full")) {
    const test::TemporaryFolder folder;
    fs::create_symlink("/dev/full", folder.path() / "floor.tif.part");
    EXPECT_THROW(WriteGeoTiff(folder.path() / "floor.tif", Draw(1)), WriteError);
  }
}

std::vector<PointOfInterest> Read(const std::string& text) {
  std::istringstream stream(text);
  return ReadPointsOfInterest(stream, "marks.csv");
}

std::string FaultOf(const std::string& text) {
  try {
    Read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(PointsOfInterest, AreReadByTheNamesOfTheirColumns) {
  const auto points =
      Read("type, Y ,x,text\r\nvictim,2,-1.5,\"a \"\"doll\"\", red\"\r\n\nqr,0,1e1,\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].p_map_m, Eigen::Vector3d(-1.5, 2.0, 0.0));
  EXPECT_EQ(points[0].text, "a \"doll\", red");
  EXPECT_EQ(points[0].id, "1");
  EXPECT_EQ(points[1].id, "2");
  EXPECT_EQ(points[1].p_map_m.x(), 10.0);
}

TEST(PointsOfInterest, ComeBackFromTheListOfTheLeague) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "pois.csv";
  PointOfInterest point = Mark("7", "hazmat", 1.25, -2.5);
  point.time = "10:20:30";
  point.text = "acid, \"2\"";
  point.mode = "A";
  WritePointsOfInterest(file, {"Q \"W\"", "NL", "2026-07-04", "10:15:00", "Prelim1"}, {&point, 1});
  EXPECT_EQ(
      test::ReadFile(file),
      "\"pois\"\n\"1.2\"\n\"Q \"\"W\"\"\"\n\"NL\"\n\"2026-07-04\"\n\"10:15:00\"\n\"Prelim1\"\n\n"
      "id,time,text,x,y,z,robot,mode,type\n"
      "7,10:20:30,\"acid, \"\"2\"\"\",1.250,-2.500,0.000,1,A,hazmat\n");
  const auto points = ReadPointsOfInterest(file);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].p_map_m, point.p_map_m);
  EXPECT_EQ(points[0].text, point.text);
}

TEST(PointsOfInterest, TellWhatIsWrongAndWhere) {
  EXPECT_NE(FaultOf("").find("no line names the columns x, y and type"), std::string::npos);
  EXPECT_EQ(FaultOf("x,y,type\n1,2,victim\n1,abc,victim\n"),
            "marks.csv:3: y is to be a number of metres, not 'abc'");
  EXPECT_EQ(FaultOf("x,y,type\n1,nan,victim\n"),
            "marks.csv:2: y is to be a number of metres, not 'nan'");
  EXPECT_EQ(FaultOf("x,y,type\n1,2\n"), "marks.csv:2: has 2 fields, but 3 columns are named");
  EXPECT_EQ(FaultOf("x,y,type\n1,2,\"v\n"), "marks.csv:2: a quote is not closed");
  EXPECT_NE(FaultOf(std::string("\0\0\0", 3)).find("no line of text"), std::string::npos);
}

TEST(PointsOfInterest, AreVictimsHazardsOrObjects) {
  EXPECT_EQ(KindOf("Victim"), InterestKind::kVictim);
  EXPECT_EQ(KindOf("hazmat_sign"), InterestKind::kHazard);
  EXPECT_EQ(KindOf("qr"), InterestKind::kObject);
}

}  // namespace
}  // namespace qwsm::io
