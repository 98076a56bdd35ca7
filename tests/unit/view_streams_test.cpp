// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What those who look on are sent: recent samples, and the tiles of a map.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "service/io/bags/messages/message_reader.hpp"
#include "service/view/streams/map_tiles.hpp"
#include "service/view/streams/recent_samples.hpp"

namespace qwsm::view {
namespace {

using namespace std::chrono_literals;

Sample SampleAt(Clock::duration time, std::uint64_t number) {
  return {.owner = {}, .bytes = {}, .stamp_ns = number, .arrived = Clock::time_point(time)};
}

std::vector<std::uint64_t> Read(const SampleStream& stream, Cursor& cursor, Clock::duration now) {
  std::vector<std::uint64_t> numbers;
  while (const auto sample = stream.Next(cursor, Clock::time_point(now))) {
    numbers.push_back(sample->stamp_ns);
  }
  return numbers;
}

using Numbers = std::vector<std::uint64_t>;

TEST(RecentSamples, ComeInOrderToWhoeverIsInTime) {
  RecentSamples samples({});
  samples.Add(SampleAt(0ms, 0));
  Cursor cursor = samples.Begin();
  EXPECT_EQ(Read(samples, cursor, 0ms), Numbers{});  // What was before is over.
  for (std::uint64_t i = 1; i < 4; ++i) samples.Add(SampleAt(10ms * i, i));
  EXPECT_EQ(Read(samples, cursor, 50ms), (Numbers{1, 2, 3}));
  EXPECT_EQ(Read(samples, cursor, 50ms), Numbers{});
}

TEST(RecentSamples, OfWhatIsOutdatedTheNewestCounts) {
  RecentSamples samples({});
  Cursor cursor = samples.Begin();
  for (std::uint64_t i = 0; i < 10; ++i) samples.Add(SampleAt(10ms * i, i));
  EXPECT_EQ(Read(samples, cursor, 150ms), (Numbers{5, 6, 7, 8, 9}));
  cursor = 0;
  EXPECT_EQ(Read(samples, cursor, 1h), Numbers{9});
}

TEST(RecentSamples, LateComersGetAllThatIsKept) {
  RecentSamples samples({.depth = 3, .for_late_comers = ForLateComers::kAll});
  for (std::uint64_t i = 0; i < 5; ++i) samples.Add(SampleAt(0ms, i));
  Cursor cursor = samples.Begin();
  EXPECT_EQ(Read(samples, cursor, 1h), (Numbers{2, 3, 4}));
  Cursor behind = 0;  // Somebody who was not there for long.
  EXPECT_EQ(Read(samples, behind, 1h), (Numbers{2, 3, 4}));
}

TEST(RecentSamples, LateComersGetTheLastOneWhereItSaysHowThingsAre) {
  RecentSamples samples({.for_late_comers = ForLateComers::kLast});
  EXPECT_EQ(samples.Begin(), 0U);
  for (std::uint64_t i = 0; i < 5; ++i) samples.Add(SampleAt(0ms, i));
  Cursor cursor = samples.Begin();
  EXPECT_EQ(Read(samples, cursor, 1h), Numbers{4});
  Cursor behind = 0;
  EXPECT_EQ(Read(samples, behind, 1h), Numbers{4});
}

/// A map of the size and place as told, all free.
struct Drawn {
  GridMessage grid;
  std::string cells;

  Drawn(std::uint32_t width, std::uint32_t height, double x_m, double y_m)
      : cells(std::size_t{width} * height, '\0') {
    grid.frame = "map";
    grid.cell_m = 0.5F;
    grid.width = width;
    grid.height = height;
    grid.x_m = x_m;
    grid.y_m = y_m;
  }
  Drawn& Set(std::uint32_t x, std::uint32_t y, char value) {
    cells[std::size_t{y} * grid.width + x] = value;
    return *this;
  }
  GridMessage message() const {
    GridMessage message = grid;
    message.cells = cells;
    return message;
  }
};

/// Puts tiles together again: cells that are known, by their column and row from the origin.
class Page {
 public:
  /// @returns how many tiles came.
  int Read(const MapTiles& tiles) {
    int count = 0;
    while (const auto sample = tiles.Next(cursor_, {})) {
      Take(sample->bytes);
      ++count;
    }
    return count;
  }
  std::map<std::pair<long, long>, int> known;
  std::uint32_t generation = 0;

 private:
  void Take(std::string_view cdr) {
    io::MessageReader reader(cdr, io::Encoding::kCdr);
    static_cast<void>(reader.Unsigned32());
    static_cast<void>(reader.Unsigned32());
    EXPECT_EQ(reader.String(), "map");
    generation = reader.Unsigned32();
    const double cell_m = static_cast<double>(reader.Float());
    const long column = std::lround(reader.Double() / cell_m);
    const long row = std::lround(reader.Double() / cell_m);
    const long width = reader.Unsigned32();
    const long height = reader.Unsigned32();
    long at = 0;
    for (const char byte : std::string(reader.Bytes(reader.Count(1)))) {
      const auto run = static_cast<unsigned char>(byte);
      for (int left = (run & 63) + 1; left > 0; --left, ++at) {
        const std::pair place(column + at % width, row + at / width);
        if (run >> 6 == 0)
          known.erase(place);
        else
          known[place] = run >> 6;
      }
    }
    EXPECT_EQ(at, width * height);
  }

  Cursor cursor_ = 0;
};

TEST(MapTiles, TogetherAreTheMap) {
  MapTiles tiles;
  const Drawn map = Drawn(150, 3, -37.5, 2.0).Set(0, 0, 100).Set(149, 2, -1);
  tiles.Take(map.message(), 0, {});
  Page page;
  EXPECT_EQ(page.Read(tiles), 4);  // Columns from -75 to 74 lie on four tiles.
  EXPECT_EQ(page.known.size(), 150U * 3 - 1);
  EXPECT_EQ((page.known[{-75, 4}]), 2);
  EXPECT_EQ((page.known[{0, 5}]), 1);
  EXPECT_FALSE(page.known.contains({74, 6}));
}

TEST(MapTiles, OnlyWhatHasChangedIsSentAgain) {
  MapTiles tiles;
  Drawn map(640, 640, 0.0, 0.0);
  tiles.Take(map.message(), 0, {});
  Page page;
  EXPECT_EQ(page.Read(tiles), 100);
  tiles.Take(map.message(), 0, {});
  EXPECT_EQ(page.Read(tiles), 0);
  tiles.Take(map.Set(70, 70, 100).Set(71, 70, 100).message(), 0, {});
  EXPECT_EQ(page.Read(tiles), 1);
  EXPECT_EQ((page.known[{70, 70}]), 2);
  Page late;
  EXPECT_EQ(late.Read(tiles), 100);
  EXPECT_EQ(late.known, page.known);
}

TEST(MapTiles, AMapThatGrowsKeepsItsTiles) {
  MapTiles tiles;
  tiles.Take(Drawn(64, 64, 0.0, 0.0).Set(3, 3, 100).message(), 0, {});
  Page page;
  EXPECT_EQ(page.Read(tiles), 1);
  tiles.Take(Drawn(128, 64, -32.0, 0.0).Set(67, 3, 100).message(), 0, {});
  EXPECT_EQ(page.Read(tiles), 1);  // What was there has not changed.
  EXPECT_EQ(page.generation, 1U);
  tiles.Take(Drawn(64, 64, 0.2, 0.0).message(), 0, {});
  EXPECT_EQ(page.Read(tiles), 1);  // On another lattice all begins anew.
  EXPECT_EQ(page.generation, 2U);
}

}  // namespace
}  // namespace qwsm::view
