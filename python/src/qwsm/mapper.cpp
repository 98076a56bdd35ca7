// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/mapper.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>

#include "python/src/option_dict.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "qwsm/geometry/position.hpp"

namespace qwsm::python {

namespace py = pybind11;

namespace {

void AddStep(py::module_& module) {
  py::class_<MappingStep>(module, "MappingStep", "The mapper's answer to one scan.")
      .def_property_readonly("stamp_ns", [](const MappingStep& step) { return step.stamp.count(); })
      .def_property_readonly(
          "status",
          [](const MappingStep& step) { return std::string(Name(step.status)); },
          "Where the pose comes from: 'first', 'matched', 'extended', 'dead-reckoned' or 'lost'.")
      .def_property_readonly(
          "reason",
          [](const MappingStep& step) { return std::string(step.reason); },
          "Why that status, in words.")
      .def_readonly("map_robot",
                    &MappingStep::map_robot,
                    "The pose with the covariance of all error since the start.")
      .def_readonly("local_covariance",
                    &MappingStep::local_covariance,
                    "Covariance of the error relative to the map around the robot.")
      .def_readonly(
          "odometry_motion",
          &MappingStep::odometry_motion,
          "Motion since the last scan as odometry tells it, as uncertain as it has proved "
          "to be.")
      .def_readonly("match", &MappingStep::match)
      .def_readonly(
          "closed_loop", &MappingStep::closed_loop, "The pose does not continue the one before.")
      .def_readonly(
          "relevant", &MappingStep::relevant, "Whether the map is extended with this scan.");
}

}  // namespace

void AddMapper(py::module_& module) {
  AddStep(module);
  py::class_<Mapper>(
      module,
      "Mapper",
      "Incremental mapping (Visser et al. 2009, sections 3 and 4) by one robot: each scan is "
      "matched "
      "with the union of all relevant scans before it, and relevant ones extend the map. What was "
      "found is never corrected afterwards; map_log does so. Deterministic; reads no clock. "
      "Threads "
      "may share one: they take turns.")
      .def(py::init(
               [](const py::dict& options) { return Mapper(OptionsFrom<MapperOptions>(options)); }),
           py::arg("options") = py::dict(),
           "options: as under `mapper` in the program's configuration (`qwsm config describe`), "
           "such "
           "as {'matcher': 'wsm', 'motion': {'rotation_per_rotation': 0.5}}; angles are in degrees "
           "there. Raises OptionError, which names every problem at once.")
      .def(
          "process",
          [](Mapper& mapper, const LaserScan& scan, const std::optional<Pose2>& T_odom_robot) {
            if (T_odom_robot && !IsPosition(*T_odom_robot)) {
              throw std::invalid_argument(
                  "T_odom_robot must be finite and within 10000 km of the origin");
            }
            // With the interpreter's lock: views into the map are read under it, too.
            return mapper.Process({.scan = scan, .T_odom_robot = T_odom_robot});
          },
          py::arg("scan"),
          py::arg("T_odom_robot") = py::none(),
          "Answers a scan, to be given in the order of time, with odometry at its stamp, if there "
          "is "
          "any.")
      .def_property_readonly("map", &Mapper::map, py::return_value_policy::reference_internal);
}

}  // namespace qwsm::python
