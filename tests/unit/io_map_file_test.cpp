// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "qwsm/mapping/mapper.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/io/maps/option_codec.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

using test::ObservationInRoom;

ScanMap MapOfRoom() {
  MapperOptions options;
  options.map.max_density_points = 4;
  Mapper mapper(options);
  for (int scan = 0; scan < 40; ++scan) static_cast<void>(mapper.Process(ObservationInRoom(scan)));
  return mapper.map();
}

std::string Complaint(std::string_view bytes) {
  try {
    DecodeMap(bytes, "room.map");
  } catch (const MapFileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MapFile, GivesTheSameMapBack) {
  const ScanMap map = MapOfRoom();
  ASSERT_GT(map.scans().size(), 3U);
  const std::string bytes = EncodeMap(map);
  const ScanMap loaded = DecodeMap(bytes, "room.map");
  EXPECT_EQ(EncodeMap(loaded), bytes);
  EXPECT_EQ(loaded.options().max_density_points, 4);
  EXPECT_EQ(loaded.scans().size(), map.scans().size());
  EXPECT_EQ(loaded.surfaces().quadtree().size(), map.surfaces().quadtree().size());
}

TEST(MapFile, TakesOptionsByTheirNamesOfBefore) {
  BinaryWriter before;
  AddOptions(before, {{"crowd_points", 4.0}, {"crowd_radius_m", 0.07}});
  BinaryReader reader(before.bytes());
  OptionValues values = ReadOptions(reader);
  ScanMapOptions options;
  OptionRestorer restorer(values);
  Describe(restorer, options);
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(options.max_density_points, 4);
  EXPECT_EQ(options.density_radius_m, 0.07);
}

TEST(MapFile, MappingGoesOnAsIfItHadNeverStopped) {
  const ScanMap map = MapOfRoom();
  const UncertainPose2 start{.T_a_b = test::PoseInRoom(40)};
  Mapper in_memory({}, map, start);
  Mapper from_file({}, DecodeMap(EncodeMap(map), "room.map"), start);
  for (int scan = 40; scan < 80; ++scan) {
    SCOPED_TRACE(scan);
    const MappingStep a = in_memory.Process(ObservationInRoom(scan));
    const MappingStep b = from_file.Process(ObservationInRoom(scan));
    EXPECT_EQ(a.map_robot.T_a_b, b.map_robot.T_a_b);
    EXPECT_EQ(a.map_robot.covariance, b.map_robot.covariance);
    EXPECT_EQ(a.relevant, b.relevant);
  }
  EXPECT_EQ(EncodeMap(in_memory.map()), EncodeMap(from_file.map()));
}

TEST(MapFile, KeepsAnEmptyMap) { EXPECT_TRUE(DecodeMap(EncodeMap(ScanMap()), "room.map").empty()); }

TEST(MapFile, KeepsTheMarksOnTheMap) {
  const ScanMap map = MapOfRoom();
  const std::vector<std::string> marks{"first", "", std::string("\0x", 2)};
  const std::string bytes = EncodeMap(map, marks);
  EXPECT_EQ(DecodeMarksOfMap(bytes, "room.map"), marks);
  EXPECT_EQ(EncodeMap(DecodeMap(bytes, "room.map")), EncodeMap(map));
  EXPECT_TRUE(DecodeMarksOfMap(EncodeMap(map), "room.map").empty());
  EXPECT_EQ(EncodeMap(map)[8], 1);  // Older releases read it.
  EXPECT_THROW(DecodeMarksOfMap(bytes.substr(0, 60), "room.map"), MapFileError);
}

TEST(MapFile, SaysExactlyWhatIsWrong) {
  const std::string bytes = EncodeMap(MapOfRoom());
  EXPECT_EQ(Complaint(""), "room.map: is no map of qwsm");
  EXPECT_EQ(Complaint("\x89PNG\r\n\x1a\n and so on"), "room.map: is no map of qwsm");
  EXPECT_EQ(Complaint(bytes.substr(0, 12)), "room.map: is truncated");
  EXPECT_EQ(
      Complaint(bytes.substr(0, 1000)),
      "room.map: is truncated: only 1000 of " + std::to_string(bytes.size()) + " bytes are there");
  EXPECT_EQ(Complaint(bytes + "x"), "room.map: is damaged: 1 bytes too many");
  std::string newer = bytes;
  newer[8] = 7;
  EXPECT_EQ(Complaint(newer),
            "room.map: is a map of version 7; this release of qwsm reads versions 1 and 2");
  std::string flipped = bytes;
  flipped[bytes.size() / 2] ^= 1;
  EXPECT_EQ(Complaint(flipped), "room.map: is damaged: its checksum is wrong");
}

TEST(MapFile, NoticesEveryFlippedBitAndEveryMissingByte) {
  const std::string bytes = EncodeMap(MapOfRoom());
  for (std::size_t at = 0; at < bytes.size(); at += at < 100 ? 1 : 997) {
    std::string flipped = bytes;
    flipped[at] ^= 0x10;
    EXPECT_NE(Complaint(flipped), "accepted") << at;
    EXPECT_NE(Complaint(bytes.substr(0, at)), "accepted") << at;
  }
}

TEST(MapFile, IsReadFromDisk) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "room.map";
  const ScanMap map = MapOfRoom();
  SaveMap(file, map);
  EXPECT_EQ(EncodeMap(LoadMap(file)), EncodeMap(map));
  EXPECT_THROW(LoadMap("/dev/zero"), MapFileError);
  EXPECT_THROW(LoadMap(folder.path() / "none.map"), std::runtime_error);
  EXPECT_THROW(SaveMap(folder.path() / "none/room.map", map), WriteError);
}

}  // namespace
}  // namespace qwsm::io
