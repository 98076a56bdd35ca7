// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_map.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>

#include "python/src/arrays.hpp"
#include "python/src/option_dict.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/io/maps/map_file.hpp"

namespace qwsm::python {
namespace {

py::array CellsOf(const py::object& self) {
  const auto& grid = self.cast<const OccupancyGrid&>();
  const auto* first = reinterpret_cast<const std::uint8_t*>(grid.cells.data());
  py::array cells = ViewOf(grid.cells, first, {}, self);
  return cells.attr("reshape")(grid.height, grid.width);
}

py::tuple ExtentOf(const OccupancyGrid& grid) {
  const Eigen::Vector2d& low = grid.origin_map_m;
  return py::make_tuple(
      low.x(), low.x() + grid.width * grid.cell_m, low.y(), low.y() + grid.height * grid.cell_m);
}

OccupancyGrid Render(const ScanMap& map, const py::dict& options) {
  const auto rendering = OptionsFrom<OccupancyGridOptions>(options);
  OccupancyGridResult result = RenderOccupancyGrid(map.scans(), rendering);
  switch (result.status) {
    case RenderStatus::kRendered:
      break;
    case RenderStatus::kNothingMeasured:
      throw std::invalid_argument("no scan of the map has a beam that says anything");
    case RenderStatus::kTooLarge:
      throw std::invalid_argument(
          "the map would have too many cells; the smallest possible cell_m is " +
          std::to_string(result.smallest_cell_m));
  }
  return std::move(result.grid);
}

void AddGrid(py::module_& module) {
  py::class_<OccupancyGrid>(
      module, "OccupancyGrid", "A map of square cells along the axes of the frame `map`.")
      .def_readonly("cell_m", &OccupancyGrid::cell_m)
      .def_readonly(
          "origin_map_m", &OccupancyGrid::origin_map_m, "Lower-left corner of cell (0, 0).")
      .def_property_readonly(
          "cells",
          &CellsOf,
          "0 unknown, 1 free, 2 occupied: (height, width), lowest y first; a view.")
      .def_property_readonly("extent_m",
                             &ExtentOf,
                             "(left, right, bottom, top): as matplotlib's imshow(origin='lower', "
                             "extent=...) wants it.");
}

}  // namespace

void AddScanMap(py::module_& module) {
  AddGrid(module);
  py::class_<RelevantScan>(
      module, "RelevantScan", "A scan that the map was extended with, and where it was taken.")
      .def_readonly("id", &RelevantScan::id)
      .def_readonly("scan", &RelevantScan::scan)
      .def_readonly("map_robot", &RelevantScan::map_robot);
  py::class_<ScanMap>(
      module,
      "ScanMap",
      "The union of all relevant scans: their points, searchable, and the scans themselves.")
      .def_property_readonly(
          "quadtree",
          [](const ScanMap& map) -> const PointQuadtree& { return map.surfaces().quadtree(); },
          py::return_value_policy::reference_internal,
          "The stored points. Only to be asked: insert into a tree of your own.")
      .def_property_readonly("scans",
                             [](const ScanMap& map) {
                               return std::vector<RelevantScan>(map.scans().begin(),
                                                                map.scans().end());
                             })
      .def("__len__", [](const ScanMap& map) { return map.scans().size(); })
      .def("occupancy",
           &Render,
           py::arg("options") = py::dict(),
           "Renders what the scans saw. options: as under `rendering` in the program's "
           "configuration, "
           "such as {'cell_m': 0.02}. Raises ValueError where there is nothing to draw, or too "
           "much.")
      .def(
          "save",
          [](const ScanMap& map, const std::filesystem::path& path) { io::SaveMap(path, map); },
          py::arg("path"),
          "Saves the map, for load_map and `qwsm localize`.");
  module.def("load_map",
             &io::LoadMap,
             py::arg("path"),
             py::call_guard<py::gil_scoped_release>(),
             "Loads what ScanMap.save or `qwsm map --save-map` wrote. Raises MapFileError.");
}

}  // namespace qwsm::python
