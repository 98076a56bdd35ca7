// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "service/view/streams/sample_stream.hpp"

namespace qwsm::view {

/// A drawn map as it came over the wire: nav_msgs/OccupancyGrid.
struct GridMessage {
  std::uint32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame;
  float cell_m = 0.0F;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double x_m = 0.0;  ///< Lower-left corner of the first cell, in the frame.
  double y_m = 0.0;
  std::string_view cells;  ///< Row by row, lowest y first: 0 free, 100 occupied, -1 unknown.
};

/// Unpacks a grid. @throws io::MessageError where the bytes are none, or make no sense.
GridMessage DecodeGrid(std::string_view cdr);

/// A map cut into squares, of which each is sent when it has changed: whoever comes gets the whole
/// map, whoever is there what is new, and whoever is slow the newest state of what has changed.
class MapTiles final : public SampleStream {
 public:
  /// One of noise alone has 4 kB: what holds up a pose on a line of 1 Mbit/s for 33 ms.
  static constexpr std::int64_t kTileCells = 64;

  /// Takes the map as it is now. O(cells).
  void Take(const GridMessage& grid, std::uint64_t stamp_ns, Clock::time_point now);

  std::size_t size() const { return tiles_.size(); }
  Cursor Begin() const override { return 0; }
  std::optional<Sample> Next(Cursor& cursor, Clock::time_point now) const override;

 private:
  /// Column and row of a tile, counted from the frame's origin.
  using Place = std::pair<std::int64_t, std::int64_t>;

  /// How the cells of a grid lie in the plane.
  struct Lattice {
    double cell_m = 0.0;
    std::int64_t column = 0;  ///< Of the grid's first cell, counted from the frame's origin.
    std::int64_t row = 0;
    double rest_x_m = 0.0;  ///< What is left: cells need not meet the origin.
    double rest_y_m = 0.0;

    explicit Lattice(const GridMessage& grid);
    bool FitsWith(const Lattice& other) const;
  };

  struct Tile {
    std::string runs;
    Cursor version = 0;
    Sample sample{};
  };

  void StartAnew(const Lattice& lattice);
  void Update(const Place& place, std::string runs, const GridMessage& grid, const Sample& like);
  std::string Encode(const Place& place, const std::string& runs, const GridMessage& grid) const;

  Lattice lattice_{GridMessage{}};
  std::uint32_t generation_ = 0;  // Of tiles that lie on one lattice.
  std::map<Place, Tile> tiles_;
  std::map<Cursor, Place> by_version_;
  Cursor last_version_ = 0;
};

}  // namespace qwsm::view
