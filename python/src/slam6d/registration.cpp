// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <Eigen/LU>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "python/src/arrays.hpp"
#include "python/src/option_dict.hpp"
#include "python/src/slam6d/bindings.hpp"
#include "service/io/clouds/scan_points.hpp"
#include "slam6d/geometry/position.hpp"
#include "slam6d/graph/ceres_loop_closer.hpp"
#include "slam6d/icp/icp.hpp"
#include "slam6d/mapping/slam.hpp"

namespace slam6d::python {

namespace py = pybind11;
using qwsm::python::ArrayOf;
using qwsm::python::OptionsFrom;

namespace {

using Transform = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

PointCloud CloudOf(const ArrayOf<double>& points_m) {
  qwsm::python::CheckColumns(points_m, 3, "points_m");
  PointCloud cloud(static_cast<std::size_t>(points_m.shape(0)));
  const auto rows = points_m.unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    cloud.Set(static_cast<std::size_t>(i), {rows(i, 0), rows(i, 1), rows(i, 2)});
  }
  return cloud;
}

py::array_t<double> PointsOf(const PointCloud& cloud) {
  py::array_t<double> points_m({static_cast<py::ssize_t>(cloud.size()), py::ssize_t{3}});
  auto rows = points_m.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const Eigen::Vector3d p_m = cloud[static_cast<std::size_t>(i)];
    for (py::ssize_t axis = 0; axis < 3; ++axis) rows(i, axis) = p_m(axis);
  }
  return points_m;
}

/// Poses of files have six digits, and those in floats lose more when multiplied.
constexpr double kMostDeviation = 1e-3;

Pose3 PoseOf(const Transform& T) {
  const Eigen::Matrix3d rotation = T.topLeftCorner<3, 3>();
  if (!T.allFinite() || T.row(3) != Eigen::RowVector4d(0, 0, 0, 1) ||
      !(rotation.determinant() > 0.0)) {
    throw std::invalid_argument("a pose must be a rigid transform: 4x4, rotation and translation");
  }
  const double deviation =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation <= kMostDeviation)) {
    throw std::invalid_argument(
        fmt::format("a pose must be a rigid transform: its rotation R is off by {:.2g} in R R^T, "
                    "where {:.2g} is rounding",
                    deviation,
                    kMostDeviation));
  }
  const Pose3 pose{.rotation = NearestRotation(rotation),
                   .translation_m = T.topRightCorner<3, 1>()};
  if (!IsPosition(pose)) {
    throw std::invalid_argument("a pose must be within 10000 km of the origin, in metres");
  }
  return pose;
}

Transform TransformOf(const Pose3& pose) {
  Transform T = Transform::Identity();
  T.topLeftCorner<3, 3>() = pose.rotation;
  T.topRightCorner<3, 1>() = pose.translation_m;
  return T;
}

IcpResult AlignClouds(const ScanModel& ref,
                      const ScanModel& cur,
                      const Transform& T_ref_cur_guess,
                      const py::dict& options) {
  const auto icp = OptionsFrom<IcpOptions>(options);
  const Pose3 guess = PoseOf(T_ref_cur_guess);
  const py::gil_scoped_release without_gil;
  return Align(ref, cur, guess, icp);
}

/// A map of scans with the solver that closes its loops. Threads take turns.
class SolvingSlam {
 public:
  explicit SolvingSlam(const SlamOptions& options) : slam_(options, closer_) {}

  /// What a function of the map returns, which is called while other threads run Python.
  template <class Function>
  auto With(const Function& function) {
    const py::gil_scoped_release without_gil;
    const std::lock_guard lock(mutex_);
    return function(slam_);
  }

 private:
  std::mutex mutex_;
  graph::CeresLoopCloser closer_;
  Slam slam_;
};

SlamStep AddScan(SolvingSlam& self, const ArrayOf<double>& points_m, const Transform& T_odom_scan) {
  const PointCloud cloud = CloudOf(points_m);
  const Pose3 odometry = PoseOf(T_odom_scan);
  return self.With([&](Slam& slam) { return slam.Add(cloud, odometry); });
}

std::vector<Transform> PosesOf(SolvingSlam& self) {
  return self.With([](const Slam& slam) {
    std::vector<Transform> poses;
    for (const Pose3& pose : slam.T_map_scan()) poses.push_back(TransformOf(pose));
    return poses;
  });
}

py::array_t<double> ReadPoints(const std::filesystem::path& path) {
  const io::ScanPoints points = io::ReadScanPoints(path);
  if (points.skipped_lines > 0) {
    const std::string problem = fmt::format(
        "{} ({} of this kind; the rest is used)", points.first_problem, points.skipped_lines);
    if (PyErr_WarnEx(PyExc_UserWarning, problem.c_str(), 1) != 0) throw py::error_already_set();
  }
  return PointsOf(points.cloud);
}

void AddAlign(py::module_& module) {
  py::class_<ScanModel>(
      module,
      "ScanModel",
      "A cloud made ready for registration, as reference and as current scan alike: "
      "with its kd-tree and its surfaces. It is in the scanner's frame.")
      .def(py::init([](const ArrayOf<double>& points_m) { return ScanModel(CloudOf(points_m)); }),
           py::arg("points_m"))
      .def("__len__", [](const ScanModel& model) { return model.points.size(); });
  py::class_<IcpResult>(module, "IcpResult", "What ICP found.")
      .def_property_readonly(
          "status", [](const IcpResult& result) { return std::string(Name(result.status)); })
      .def_property_readonly(
          "T_ref_cur",
          [](const IcpResult& result) { return TransformOf(result.T_ref_cur); },
          "Best estimate so far, whatever the status: a 4x4 matrix.")
      .def_readonly("covariance",
                    &IcpResult::covariance,
                    "Covariance of (x, y, z, roll, pitch, yaw), in m^2, m rad and rad^2, the "
                    "translation along the axes of the reference: to planes by how far the pairs "
                    "scatter, and the guess in what they leave open; to points as if thirty of the "
                    "pairs were independent. Zero, which says nothing, unless the status is "
                    "'converged' or that the iteration limit was reached.")
      .def_readonly("iterations", &IcpResult::iterations)
      .def_readonly("pairs", &IcpResult::pairs)
      .def_readonly("rms_residual_m", &IcpResult::rms_residual_m);
  module.def(
      "align",
      &AlignClouds,
      py::arg("reference"),
      py::arg("scan"),
      py::arg_v("T_ref_cur_guess", Transform(Transform::Identity()), "numpy.identity(4)"),
      py::arg("options") = py::dict(),
      "Aligns a scan with a reference, beginning at a guess (Nuechter et al. 2007, section 3.3). "
      "options: as under `slam.icp` in the program's configuration (`slam6d config --describe`), "
      "where angles are in degrees: {'guess_sigma_deg': 5}.");
}

void AddSlam(py::module_& module) {
  py::class_<SlamStep>(module, "SlamStep", "What became of one scan.")
      .def_property_readonly("status",
                             [](const SlamStep& step) { return std::string(Name(step.status)); })
      .def_property_readonly("T_map_scan",
                             [](const SlamStep& step) { return TransformOf(step.T_map_scan); })
      .def_readonly("covariance",
                    &SlamStep::covariance,
                    "Covariance of (x, y, z, roll, pitch, yaw) of all error since the first scan, "
                    "along the axes of the map.")
      .def_readonly("match", &SlamStep::match)
      .def_readonly("overlap",
                    &SlamStep::overlap,
                    "Share of the scan's points that lie on what the scans before saw.")
      .def_readonly("loops_to", &SlamStep::loops_to, "Earlier scans with which a loop was closed.");
  py::class_<SolvingSlam>(
      module,
      "Slam",
      "6D SLAM (Nuechter et al. 2007, section 3): scans taken one after the other, "
      "in one consistent model. Threads may share one: they take turns.")
      .def(py::init([](const py::dict& options) {
             return std::make_unique<SolvingSlam>(OptionsFrom<SlamOptions>(options));
           }),
           py::arg("options") = py::dict(),
           "options: as under `slam` in the program's configuration (`slam6d config --describe`), "
           "where angles are in degrees.")
      .def("add",
           &AddScan,
           py::arg("points_m"),
           py::arg("T_odom_scan"),
           "Adds a scan, (n, 3) in the scanner's frame, with its pose by odometry or any estimate. "
           "The "
           "poses of earlier ones change where it closes a loop.")
      .def_property_readonly("poses", &PosesOf, "Poses of all scans in the map, as 4x4 matrices.")
      .def(
          "refine",
          [](SolvingSlam& self) {
            self.With([](Slam& slam) { static_cast<void>(slam.Refine()); });
          },
          "Fits all scans to each other, where refinement.enabled says so.");
}

}  // namespace

void AddRegistration(py::module_& module) {
  module.def(
      "read_points",
      &ReadPoints,
      py::arg("path"),
      "Points (n, 3) of a file in the scanner's frame, right-handed, in metres: .3d of 3DTK, .xyz, "
      ".txt, .ply, .pcd or KITTI's .bin; .gz, .bz2 or .xz may follow. What is no point is left out "
      "and told as a UserWarning.");
  AddAlign(module);
  AddSlam(module);
}

}  // namespace slam6d::python
