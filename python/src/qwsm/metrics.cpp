// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <cmath>

#include "python/src/arrays.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "python/src/qwsm/lists.hpp"
#include "qwsm/metrics/trajectory_error.hpp"
#include "service/io/trajectories/relations_file.hpp"
#include "service/io/trajectories/trajectory_file.hpp"

namespace qwsm::python {
namespace {

std::chrono::nanoseconds Nanoseconds(double duration_s) {
  if (!(duration_s >= 0.0 && duration_s < 1e9)) {
    throw std::invalid_argument("a duration must be between 0 and 1e9 seconds");
  }
  return std::chrono::nanoseconds(std::llround(1e9 * duration_s));
}

Trajectory MakeTrajectory(const ArrayOf<std::int64_t>& stamps_ns, const ArrayOf<double>& poses) {
  CheckColumns(poses, 3, "poses");
  if (stamps_ns.ndim() != 1 || stamps_ns.size() != poses.shape(0)) {
    throw std::invalid_argument("stamps_ns must have one stamp for each of the poses");
  }
  Trajectory trajectory;
  trajectory.reserve(static_cast<std::size_t>(stamps_ns.size()));
  for (py::ssize_t i = 0; i < stamps_ns.size(); ++i) {
    trajectory.push_back({.stamp = Timestamp(stamps_ns.at(i)),
                          .T_map_robot = {poses.at(i, 0), poses.at(i, 1), poses.at(i, 2)}});
  }
  return trajectory;
}

py::array PosesOf(const py::object& self) {
  const auto& poses = self.cast<const Trajectory&>();
  return ViewOf(poses, poses.empty() ? nullptr : &poses[0].T_map_robot.x_m, {3}, self);
}

py::array StampsOf(const py::object& self) {
  static_assert(sizeof(Timestamp) == sizeof(std::int64_t));
  const auto& poses = self.cast<const Trajectory&>();
  const auto* first =
      poses.empty() ? nullptr : reinterpret_cast<const std::int64_t*>(&poses[0].stamp);
  return ViewOf(poses, first, {}, self);
}

void AddTrajectory(py::module_& module) {
  py::class_<Trajectory>(
      module, "Trajectory", "Poses of the robot in the order in which they were estimated.")
      .def(py::init(&MakeTrajectory), py::arg("stamps_ns"), py::arg("poses"))
      .def_property_readonly("stamps_ns", &StampsOf, "Stamps in nanoseconds: (n,), a view.")
      .def_property_readonly(
          "poses", &PosesOf, "x_m, y_m and theta_rad of the robot in the map: (n, 3), a view.")
      .def("__len__", &Trajectory::size)
      .def(
          "save",
          [](const Trajectory& trajectory, const std::filesystem::path& path) {
            io::WriteTumFile(path, trajectory);
          },
          py::arg("path"),
          "Writes lines `t x y z qx qy qz qw`, as TUM, evo and rpg_trajectory_evaluation read "
          "them.");
  module.def("read_trajectory",
             &io::ReadTumFile,
             py::arg("path"),
             "Reads a TUM trajectory; of poses in space x, y and yaw are kept.");
}

void AddStatistics(py::module_& module) {
  py::class_<ErrorStatistics>(
      module, "ErrorStatistics", "What a set of error magnitudes looks like, in the errors' unit.")
      .def_readonly("count", &ErrorStatistics::count)
      .def_readonly("mean", &ErrorStatistics::mean)
      .def_readonly("standard_deviation", &ErrorStatistics::standard_deviation)
      .def_readonly("rmse", &ErrorStatistics::rmse)
      .def_readonly("median", &ErrorStatistics::median)
      .def_readonly("percentile_95", &ErrorStatistics::percentile_95)
      .def_readonly("min", &ErrorStatistics::min)
      .def_readonly("max", &ErrorStatistics::max);
  py::class_<RelationsSummary>(module, "RelationsSummary", "Errors of a set of relations.")
      .def_readonly("translation_m", &RelationsSummary::translation_m)
      .def_readonly("rotation_rad", &RelationsSummary::rotation_rad);
  py::class_<RelationsResult>(
      module, "RelationsResult", "How wrong a trajectory is about relations.")
      .def_readonly("all", &RelationsResult::all)
      .def_readonly("local", &RelationsResult::local, "Of poses at most ten seconds apart.")
      .def_readonly("global_", &RelationsResult::global, "Of all others.")
      .def_readonly("skipped",
                    &RelationsResult::skipped,
                    "Relations whose stamps the trajectory does not cover.");
}

RelationsResult EvaluateByRelations(const std::vector<Relation>& relations,
                                    const Trajectory& trajectory,
                                    bool interpolate,
                                    double tolerance_s) {
  return EvaluateRelations(
      relations,
      trajectory,
      {.lookup = interpolate ? PoseLookup::kInterpolated : PoseLookup::kNearest,
       .tolerance = Nanoseconds(tolerance_s)});
}

ErrorStatistics AlignedError(const Trajectory& reference,
                             const Trajectory& estimate,
                             double max_difference_s,
                             bool align) {
  const std::vector<PosePair> pairs = Associate(reference, estimate, Nanoseconds(max_difference_s));
  if (pairs.empty()) {
    throw std::invalid_argument("no two stamps of the trajectories lie within max_difference_s");
  }
  return AbsoluteTrajectoryError(pairs, align ? AlignUmeyama(pairs) : Pose2());
}

}  // namespace

void AddMetrics(py::module_& module) {
  AddTrajectory(module);
  AddStatistics(module);
  py::class_<std::vector<Relation>>(
      module, "Relations", "True poses of the robot relative to others.")
      .def("__len__", &std::vector<Relation>::size);
  module.def(
      "read_relations",
      &io::ReadRelationsFile,
      py::arg("path"),
      "Reads relations, one per line: `t1 t2 x y z roll pitch yaw` (seconds, metres, radians).");
  module.def(
      "evaluate_relations",
      &EvaluateByRelations,
      py::arg("relations"),
      py::arg("trajectory"),
      py::kw_only(),
      py::arg("interpolate") = false,
      py::arg("tolerance_s") = 0.0006,
      "The relations metric of Kuemmerle et al. (2009), Eq. (4). It does not depend on the map's "
      "frame, and drift counts once. A pose is the nearest in time, or interpolated.");
  module.def(
      "absolute_trajectory_error",
      &AlignedError,
      py::arg("reference"),
      py::arg("estimate"),
      py::kw_only(),
      py::arg("max_difference_s") = 0.01,
      py::arg("align") = true,
      "Absolute trajectory error (Sturm et al. 2012) in metres, after moving the estimate to "
      "where it fits best (Umeyama 1991, without scale): evo's APE, translation part.");
}

}  // namespace qwsm::python
