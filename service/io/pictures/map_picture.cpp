// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/map_picture.hpp"

#include "service/io/pictures/map_frame.hpp"

namespace qwsm::io {

void WriteMapPicture(const std::filesystem::path& path, const OccupancyGrid& grid) {
  const MapView view(grid, grid.origin_map_m, grid.origin_map_m);
  MapFrame(grid, view, {}).canvas().Save(path);
}

}  // namespace qwsm::io
