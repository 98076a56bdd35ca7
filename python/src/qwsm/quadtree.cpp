// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <pybind11/eigen.h>

#include <cmath>
#include <limits>
#include <vector>

#include "python/src/arrays.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "qwsm/search/point_quadtree.hpp"

namespace qwsm::python {
namespace {

Eigen::Vector2d RowOf(const ArrayOf<double>& points_m, py::ssize_t row) {
  return {points_m.at(row, 0), points_m.at(row, 1)};
}

py::array_t<PointId> InsertPoints(PointQuadtree& tree,
                                  const ArrayOf<double>& points_m,
                                  ScanId scan) {
  CheckColumns(points_m, 2, "points_m");
  if (scan >= PointQuadtree::kScanEnd) {
    throw std::invalid_argument(
        fmt::format("scan must be below {}, not {}", PointQuadtree::kScanEnd, scan));
  }
  py::array_t<PointId> ids(points_m.shape(0));
  for (py::ssize_t i = 0; i < points_m.shape(0); ++i) {
    const auto insertion = tree.Insert(RowOf(points_m, i), scan);
    if (!insertion) {
      throw std::invalid_argument(fmt::format(
          "points_m[{}] is not finite, or too far away from the first; those before it are stored",
          i));
    }
    ids.mutable_at(i) = insertion->id;
  }
  return ids;
}

py::tuple NearestPoints(const PointQuadtree& tree,
                        const ArrayOf<double>& queries_m,
                        double max_distance_m) {
  CheckColumns(queries_m, 2, "queries_m");
  py::array_t<PointId> ids(queries_m.shape(0));
  py::array_t<double> distances_m(queries_m.shape(0));
  SearchCursor cursor;
  for (py::ssize_t i = 0; i < queries_m.shape(0); ++i) {
    const auto nearest = tree.Nearest(RowOf(queries_m, i), max_distance_m, cursor);
    ids.mutable_at(i) = nearest ? nearest->id : tree.id_end();
    distances_m.mutable_at(i) =
        nearest ? std::sqrt(nearest->distance_m2) : std::numeric_limits<double>::infinity();
  }
  return py::make_tuple(ids, distances_m);
}

py::tuple KNearestPoints(const PointQuadtree& tree,
                         const Eigen::Vector2d& query_m,
                         std::size_t k,
                         double max_distance_m) {
  std::vector<Neighbor> neighbors;
  tree.KNearest(query_m, k, max_distance_m, neighbors);
  py::array_t<PointId> ids(static_cast<py::ssize_t>(neighbors.size()));
  py::array_t<double> distances_m(ids.size());
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    ids.mutable_data()[i] = neighbors[i].id;
    distances_m.mutable_data()[i] = std::sqrt(neighbors[i].distance_m2);
  }
  return py::make_tuple(ids, distances_m);
}

py::array_t<PointId> IdsOf(const std::vector<PointId>& ids) {
  return py::array_t<PointId>(static_cast<py::ssize_t>(ids.size()), ids.data());
}

py::array_t<PointId> PointsInRadius(const PointQuadtree& tree,
                                    const Eigen::Vector2d& center_m,
                                    double radius_m) {
  std::vector<PointId> ids;
  tree.ForEachInRadius(
      center_m, radius_m, [&](PointId id, const Eigen::Vector2d&) { ids.push_back(id); });
  return IdsOf(ids);
}

py::array_t<PointId> PointsInBox(const PointQuadtree& tree,
                                 const Eigen::Vector2d& low_m,
                                 const Eigen::Vector2d& high_m) {
  std::vector<PointId> ids;
  tree.ForEachInBox({low_m, high_m},
                    [&](PointId id, const Eigen::Vector2d&) { ids.push_back(id); });
  return IdsOf(ids);
}

void CheckId(const PointQuadtree& tree, PointId id) {
  if (!tree.Contains(id)) throw py::index_error(fmt::format("there is no point {}", id));
}

py::array_t<double> PositionsOf(const PointQuadtree& tree, const ArrayOf<PointId>& ids) {
  const std::vector<Eigen::Vector2d> all_m = tree.Positions();
  py::array_t<double> positions_m({ids.size(), py::ssize_t{2}});
  for (py::ssize_t i = 0; i < ids.size(); ++i) {
    const PointId id = ids.data()[i];
    CheckId(tree, id);
    positions_m.mutable_at(i, 0) = all_m[id].x();
    positions_m.mutable_at(i, 1) = all_m[id].y();
  }
  return positions_m;
}

ScanId ScanOf(const PointQuadtree& tree, PointId id) {
  CheckId(tree, id);
  return tree.Scan(id);
}

py::array_t<PointId> AllIds(const PointQuadtree& tree) {
  std::vector<PointId> ids;
  for (PointId id = 0; id < tree.id_end(); ++id) {
    if (tree.Contains(id)) ids.push_back(id);
  }
  return IdsOf(ids);
}

py::array_t<double> AllPositions(const PointQuadtree& tree) {
  return PositionsOf(tree, AllIds(tree));
}

}  // namespace

void AddQuadtree(py::module_& module) {
  py::class_<PointQuadtree>(
      module,
      "PointQuadtree",
      "Points of the plane, found by place: the map that Visser et al. (2009, section 3) match "
      "scans "
      "to. A point-region quadtree over cells of a millimetre; points of one cell are merged to "
      "their mean. Insertion and search cost O(depth).")
      .def(py::init([](double cell_size_m) { return PointQuadtree({.cell_size_m = cell_size_m}); }),
           py::arg("cell_size_m") = PointQuadtreeOptions().cell_size_m)
      .def("insert",
           &InsertPoints,
           py::arg("points_m"),
           py::arg("scan") = 0,
           "Adds points (n, 2) of a scan and returns their ids. Refused with a ValueError that "
           "names "
           "the row: a point that is not finite, or more than 1431 km from the first one.")
      .def("remove_scan",
           &PointQuadtree::RemoveScan,
           py::arg("scan"),
           "Takes out what a scan contributed; returns how many insertions were undone.")
      .def("nearest",
           &NearestPoints,
           py::arg("queries_m"),
           py::arg("max_distance_m"),
           "The nearest points not farther than max_distance_m, exact: their ids and distances. "
           "Where "
           "there is none, the distance is infinite and the id is id_end.")
      .def("k_nearest",
           &KNearestPoints,
           py::arg("query_m"),
           py::arg("k"),
           py::arg("max_distance_m"),
           "Ids and distances of the k nearest points not farther than max_distance_m, nearest "
           "first.")
      .def("in_radius",
           &PointsInRadius,
           py::arg("center_m"),
           py::arg("radius_m"),
           "Ids of the points not farther than radius_m, in no particular order.")
      .def("in_box",
           &PointsInBox,
           py::arg("low_m"),
           py::arg("high_m"),
           "Ids of the points in the box, border included, in no particular order.")
      .def("positions",
           &PositionsOf,
           py::arg("ids"),
           "Positions (n, 2) in metres: the means of the merged points.")
      .def("points", &AllPositions, "Positions (n, 2) of all points, in metres, by rising id.")
      .def("scan", &ScanOf, py::arg("id"), "The oldest contributor to a point.")
      .def_property_readonly(
          "id_end", &PointQuadtree::id_end, "One more than the largest id ever given.")
      .def("__len__", &PointQuadtree::size);
}

}  // namespace qwsm::python
