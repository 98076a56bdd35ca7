// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/streams/map_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/bags/writing/cdr_writer.hpp"

namespace qwsm::view {
namespace {

// Beyond, positions of cells are no longer exact; no team drives that far.
constexpr double kFarthest_m = 1e8;
constexpr double kSameLattice_cells = 0.02;

enum CellCode : std::uint8_t { kUnknownCell, kFreeCell, kOccupiedCell };

// Below 0 where it is unknown.
CellCode CodeOf(std::int8_t occupancy) {
  if (occupancy == 0) return kFreeCell;
  return occupancy > 50 ? kOccupiedCell : kUnknownCell;
}

/// Cells one after the other, as runs of the same state: two bits of state, six of length less one.
class RunWriter {
 public:
  void Add(CellCode cell, std::int64_t count) {
    if (cell != cell_) Flush();
    cell_ = cell;
    length_ += count;
  }
  std::string Finish() {
    Flush();
    return std::move(runs_);
  }

 private:
  static constexpr std::int64_t kLongestRun = 64;

  void Flush() {
    for (; length_ > 0; length_ -= std::min(length_, kLongestRun)) {
      runs_ += static_cast<char>((cell_ << 6) | (std::min(length_, kLongestRun) - 1));
    }
  }

  CellCode cell_ = kUnknownCell;
  std::int64_t length_ = 0;
  std::string runs_;
};

/// The cells of a tile; beyond the grid nothing is known.
/// @param first_x first_y the tile's first cell, in cells of the grid.
std::string RunsOf(const GridMessage& grid, std::int64_t first_x, std::int64_t first_y) {
  const auto width = static_cast<std::int64_t>(grid.width);
  const auto height = static_cast<std::int64_t>(grid.height);
  const std::int64_t begin = std::clamp<std::int64_t>(first_x, 0, width);
  const std::int64_t end = std::clamp<std::int64_t>(first_x + MapTiles::kTileCells, 0, width);
  RunWriter runs;
  for (std::int64_t y = first_y; y < first_y + MapTiles::kTileCells; ++y) {
    if (y < 0 || y >= height || begin >= end) {
      runs.Add(kUnknownCell, MapTiles::kTileCells);
      continue;
    }
    runs.Add(kUnknownCell, begin - first_x);
    for (std::int64_t x = begin; x < end; ++x) {
      const char cell = grid.cells[static_cast<std::size_t>(y * width + x)];
      runs.Add(CodeOf(static_cast<std::int8_t>(cell)), 1);
    }
    runs.Add(kUnknownCell, first_x + MapTiles::kTileCells - end);
  }
  return runs.Finish();
}

std::int64_t TileOf(std::int64_t cell) {
  return static_cast<std::int64_t>(
      std::floor(static_cast<double>(cell) / static_cast<double>(MapTiles::kTileCells)));
}

}  // namespace

GridMessage DecodeGrid(std::string_view cdr) {
  io::MessageReader reader(cdr, io::Encoding::kCdr);
  GridMessage grid;
  grid.sec = reader.Unsigned32();
  grid.nanosec = reader.Unsigned32();
  grid.frame = reader.String();
  static_cast<void>(reader.Unsigned32());  // When the map was loaded.
  static_cast<void>(reader.Unsigned32());
  grid.cell_m = reader.Float();
  grid.width = reader.Unsigned32();
  grid.height = reader.Unsigned32();
  grid.x_m = reader.Double();
  grid.y_m = reader.Double();
  for (int i = 0; i < 5; ++i) static_cast<void>(reader.Double());  // Height and orientation.
  grid.cells = reader.Bytes(reader.Count(1));
  const bool is_somewhere = std::abs(grid.x_m) < kFarthest_m && std::abs(grid.y_m) < kFarthest_m;
  if (!(grid.cell_m >= 1e-3F && grid.cell_m <= 1e3F) || !is_somewhere) {
    throw io::MessageError("its cells have no size, or lie nowhere");
  }
  if (grid.cells.size() != std::uint64_t{grid.width} * grid.height) {
    throw io::MessageError("it has not as many cells as it says");
  }
  return grid;
}

MapTiles::Lattice::Lattice(const GridMessage& grid) : cell_m(static_cast<double>(grid.cell_m)) {
  if (cell_m == 0.0) return;
  column = std::llround(grid.x_m / cell_m);
  row = std::llround(grid.y_m / cell_m);
  rest_x_m = grid.x_m - static_cast<double>(column) * cell_m;
  rest_y_m = grid.y_m - static_cast<double>(row) * cell_m;
}

bool MapTiles::Lattice::FitsWith(const Lattice& other) const {
  const double most_m = kSameLattice_cells * cell_m;
  return cell_m == other.cell_m && std::abs(rest_x_m - other.rest_x_m) <= most_m &&
         std::abs(rest_y_m - other.rest_y_m) <= most_m;
}

void MapTiles::StartAnew(const Lattice& lattice) {
  lattice_ = lattice;
  ++generation_;
  tiles_.clear();
  by_version_.clear();
}

void MapTiles::Take(const GridMessage& grid, std::uint64_t stamp_ns, Clock::time_point now) {
  const Lattice lattice(grid);
  if (!lattice.FitsWith(lattice_)) StartAnew(lattice);
  const Sample like{.owner = {}, .bytes = {}, .stamp_ns = stamp_ns, .arrived = now};
  const auto update = [&](const Place& place) {
    Update(place,
           RunsOf(grid,
                  place.first * kTileCells - lattice.column,
                  place.second * kTileCells - lattice.row),
           grid,
           like);
  };
  std::vector<Place> known;
  for (const auto& [place, tile] : tiles_) known.push_back(place);
  for (const Place& place : known) update(place);
  if (grid.cells.empty()) return;
  for (auto row = TileOf(lattice.row); row <= TileOf(lattice.row + grid.height - 1); ++row) {
    for (auto column = TileOf(lattice.column); column <= TileOf(lattice.column + grid.width - 1);
         ++column) {
      if (!tiles_.contains({column, row})) update({column, row});
    }
  }
}

void MapTiles::Update(const Place& place,
                      std::string runs,
                      const GridMessage& grid,
                      const Sample& like) {
  Tile& tile = tiles_[place];
  if (tile.runs == runs) return;
  by_version_.erase(tile.version);
  const auto bytes = std::make_shared<const std::string>(Encode(place, runs, grid));
  tile.sample = like;
  tile.sample.owner = bytes;
  tile.sample.bytes = *bytes;
  tile.runs = std::move(runs);
  tile.version = ++last_version_;
  by_version_.emplace(tile.version, place);
}

std::string MapTiles::Encode(const Place& place,
                             const std::string& runs,
                             const GridMessage& grid) const {
  const double side_m = static_cast<double>(kTileCells) * lattice_.cell_m;
  io::CdrWriter writer;
  writer.Add(grid.sec);
  writer.Add(grid.nanosec);
  writer.Add(std::string_view(grid.frame));
  writer.Add(generation_);
  writer.Add(grid.cell_m);
  writer.Add(static_cast<double>(place.first) * side_m + lattice_.rest_x_m);
  writer.Add(static_cast<double>(place.second) * side_m + lattice_.rest_y_m);
  writer.Add(static_cast<std::uint32_t>(kTileCells));
  writer.Add(static_cast<std::uint32_t>(kTileCells));
  writer.Add(static_cast<std::uint32_t>(runs.size()));
  writer.AddBytes(runs);
  return writer.bytes();
}

std::optional<Sample> MapTiles::Next(Cursor& cursor, Clock::time_point) const {
  const auto next = by_version_.upper_bound(cursor);
  if (next == by_version_.end()) return std::nullopt;
  cursor = next->first;
  return tiles_.at(next->second).sample;
}

}  // namespace qwsm::view
