// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>

#include "python/src/arrays.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm::python {
namespace {

Pose2 MakePose(double x_m, double y_m, double theta_rad) {
  return {x_m, y_m, NormalizeAngle(theta_rad)};
}

void AddPoses(py::module_& module) {
  py::class_<Pose2>(
      module,
      "Pose2",
      "A rigid motion of the plane, SE(2). T_a_b is the pose of frame b in frame a; "
      "it maps coordinates in b to coordinates in a. Wherever one is asked for, three "
      "numbers (x_m, y_m, theta_rad) do.")
      .def(py::init(&MakePose),
           py::arg("x_m") = 0.0,
           py::arg("y_m") = 0.0,
           py::arg("theta_rad") = 0.0)
      .def(py::init([](const std::array<double, 3>& p) { return MakePose(p[0], p[1], p[2]); }),
           py::arg("x_y_theta"))
      .def_readwrite("x_m", &Pose2::x_m)
      .def_readwrite("y_m", &Pose2::y_m)
      .def_property(
          "theta_rad",
          [](const Pose2& p) { return p.theta_rad; },
          [](Pose2& p, double theta_rad) { p.theta_rad = NormalizeAngle(theta_rad); },
          "Counter-clockwise, in (-pi, pi].")
      .def("inverse", &Pose2::Inverse)
      .def(
          "__mul__",
          [](const Pose2& T_a_b, const Pose2& T_b_c) { return T_a_b * T_b_c; },
          py::arg("other"),
          py::is_operator(),
          "T_a_c = T_a_b * T_b_c.")
      .def(
          "__iter__",
          [](const Pose2& p) { return py::iter(py::make_tuple(p.x_m, p.y_m, p.theta_rad)); },
          "x_m, y_m and theta_rad, so that numpy.array(list(pose)) is what one expects.")
      .def(
          "__eq__", [](const Pose2& a, const Pose2& b) { return a == b; }, py::is_operator())
      .def("__repr__", [](const Pose2& p) {
        return fmt::format("Pose2(x_m={}, y_m={}, theta_rad={})", p.x_m, p.y_m, p.theta_rad);
      });
  py::implicitly_convertible<py::sequence, Pose2>();

  py::class_<UncertainPose2>(
      module,
      "UncertainPose2",
      "A pose and how far it may be from the truth: the covariance is of (x, "
      "y, theta) in m^2, m rad and rad^2, the translation along the axes of "
      "the parent frame a, the rotation about the origin of b.")
      .def(py::init([](const Pose2& T_a_b, const Eigen::Matrix3d& covariance) {
             return UncertainPose2{T_a_b, covariance};
           }),
           py::arg("T_a_b"),
           py::arg("covariance"))
      .def_readonly("T_a_b", &UncertainPose2::T_a_b)
      .def_readonly("covariance", &UncertainPose2::covariance)
      .def_property_readonly("sigma_xy_m", &UncertainPose2::SigmaXY_m)
      .def_property_readonly("sigma_theta_rad", &UncertainPose2::SigmaTheta_rad);
}

LaserScan MakeScan(const ArrayOf<float>& ranges_m,
                   const LaserGeometry& geometry,
                   std::int64_t stamp_ns) {
  if (ranges_m.ndim() != 1) throw std::invalid_argument("ranges_m must have one dimension");
  return {.stamp = Timestamp(stamp_ns),
          .geometry = geometry,
          .ranges_m = {ranges_m.data(), ranges_m.data() + ranges_m.size()}};
}

py::array_t<double> BearingsOf(const LaserScan& scan) {
  py::array_t<double> bearings_rad(static_cast<py::ssize_t>(scan.size()));
  double* const out = bearings_rad.mutable_data();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) out[beam] = scan.geometry.Bearing(beam);
  return bearings_rad;
}

py::array_t<double> PointsOf(const LaserScan& scan) {
  const std::vector<ScanPoint> points = ToPoints(scan);
  py::array_t<double> rows({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto out = rows.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < out.shape(0); ++i) {
    const Eigen::Vector2d& p_robot_m = points[static_cast<std::size_t>(i)].p_robot_m;
    out(i, 0) = p_robot_m.x();
    out(i, 1) = p_robot_m.y();
  }
  return rows;
}

void AddScans(py::module_& module) {
  py::class_<LaserGeometry>(module, "LaserGeometry", "Where the beams of a scan point.")
      .def(py::init<float, float, float, float, const Pose2&>(),
           py::kw_only(),
           py::arg("first_bearing_rad"),
           py::arg("bearing_step_rad"),
           py::arg("range_min_m") = 0.0F,
           py::arg("range_max_m"),
           py::arg("T_robot_laser") = Pose2())
      .def_readwrite("first_bearing_rad",
                     &LaserGeometry::first_bearing_rad,
                     "Bearing of beam 0 in the laser frame.")
      .def_readwrite(
          "bearing_step_rad",
          &LaserGeometry::bearing_step_rad,
          "Angle between neighbouring beams; negative for a scanner that turns clockwise.")
      .def_readwrite(
          "range_min_m", &LaserGeometry::range_min_m, "Readings below are too near to be trusted.")
      .def_readwrite("range_max_m",
                     &LaserGeometry::range_max_m,
                     "Readings near it and beyond mean \"no echo\".")
      .def_readwrite("T_robot_laser", &LaserGeometry::T_robot_laser);

  py::class_<LaserScan>(module, "LaserScan", "One sweep of a planar laser.")
      .def(py::init(&MakeScan),
           py::arg("ranges_m"),
           py::arg("geometry"),
           py::arg("stamp_ns") = 0,
           "Takes a copy of the ranges, as 32-bit floats.")
      .def_property_readonly("stamp_ns", [](const LaserScan& scan) { return scan.stamp.count(); })
      .def_readonly("geometry", &LaserScan::geometry)
      .def_property_readonly(
          "ranges_m",
          [](const py::object& self) {
            const auto& scan = self.cast<const LaserScan&>();
            return ViewOf(scan.ranges_m, scan.ranges_m.data(), {}, self);
          },
          "One reading per beam, in the order of the bearings: a view, not a copy.")
      .def_property_readonly(
          "bearings_rad", &BearingsOf, "Bearings of all beams in the laser frame.")
      .def("points",
           &PointsOf,
           "The points of all beams that hit something, in the robot's frame: (n, 2), in metres.")
      .def("__len__", &LaserScan::size);
}

}  // namespace

void AddGeometry(py::module_& module) {
  AddPoses(module);
  AddScans(module);
}

}  // namespace qwsm::python
