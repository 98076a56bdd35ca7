// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "python/src/qwsm/bindings.hpp"
#include "qwsm/logs/log_reader.hpp"

namespace qwsm::python {

namespace py = pybind11;

namespace {

io::LogOptions MakeLogOptions(bool strict,
                              std::string laser,
                              std::vector<std::string> scan_topics,
                              std::string odometry_topic,
                              std::string robot,
                              std::optional<double> sweep_s,
                              std::optional<Pose2> T_robot_laser,
                              std::optional<float> range_max_m,
                              std::optional<double> field_of_view_rad) {
  return {.strict = strict,
          .laser = std::move(laser),
          .scan_topics = std::move(scan_topics),
          .odometry_topic = std::move(odometry_topic),
          .robot = std::move(robot),
          .sweep_s = sweep_s,
          .T_robot_laser = T_robot_laser,
          .range_max_m = range_max_m,
          .field_of_view_rad = field_of_view_rad,
          .on_fault = {}};
}

void AddLogOptions(py::module_& module) {
  py::class_<io::LogOptions>(
      module,
      "LogOptions",
      "How a log is read. What the log states and what can be inferred from it needs no option.")
      .def(py::init(&MakeLogOptions),
           py::kw_only(),
           py::arg("strict") = false,
           py::arg("laser") = "",
           py::arg("scan_topics") = std::vector<std::string>(),
           py::arg("odometry_topic") = "",
           py::arg("robot") = "",
           py::arg("sweep_s") = py::none(),
           py::arg("T_robot_laser") = py::none(),
           py::arg("range_max_m") = py::none(),
           py::arg("field_of_view_rad") = py::none(),
           "strict: raise at a malformed line instead of skipping it. laser: name of the laser, or "
           "'all'; else the front one. Of a bag, scan_topics and odometry_topic: the topics, where "
           "there are several; robot: the namespace of one of several; sweep_s: seconds from a "
           "scan's first beam to its last. The others replace what the log says.");
}

void AddReadings(py::module_& module) {
  py::class_<io::ScanReading>(
      module,
      "ScanReading",
      "One sweep of one laser, with the odometry of its moment where the log has any.")
      .def_readonly("scan", &io::ScanReading::scan)
      .def_readonly("T_odom_robot", &io::ScanReading::T_odom_robot)
      .def_readonly("laser", &io::ScanReading::laser);
  py::class_<io::OdometryReading>(module, "OdometryReading", "The robot's own dead reckoning.")
      .def_property_readonly("stamp_ns",
                             [](const io::OdometryReading& r) { return r.stamp.count(); })
      .def_readonly("T_odom_robot", &io::OdometryReading::T_odom_robot);
  py::class_<ImuReading>(
      module, "ImuReading", "What an inertial sensor feels at a moment, about the robot's axes.")
      .def_property_readonly("stamp_ns", [](const ImuReading& r) { return r.stamp.count(); })
      .def_readonly("turn_rate_rad_s", &ImuReading::turn_rate_rad_s)
      .def_readonly("acceleration_mps2", &ImuReading::acceleration_mps2);
  py::class_<io::TruePoseReading>(module, "TruePoseReading", "Where a simulator says the robot is.")
      .def_property_readonly("stamp_ns",
                             [](const io::TruePoseReading& r) { return r.stamp.count(); })
      .def_readonly("T_world_robot", &io::TruePoseReading::T_world_robot)
      .def_readonly("T_odom_robot", &io::TruePoseReading::T_odom_robot);
}

void AddReport(py::module_& module) {
  py::class_<io::LogFault>(
      module, "LogFault", "One kind of trouble with the lines of a log, however many have it.")
      .def_readonly("what", &io::LogFault::what)
      .def_readonly("count", &io::LogFault::count)
      .def_readonly("first_line", &io::LogFault::first_line);
  py::class_<io::LogReport>(module, "LogReport", "What was found in a log so far.")
      .def_readonly("name", &io::LogReport::name)
      .def_readonly("format", &io::LogReport::format)
      .def_readonly("scans", &io::LogReport::scans)
      .def_readonly("odometry_readings", &io::LogReport::odometry_readings)
      .def_readonly("true_poses", &io::LogReport::true_poses)
      .def_readonly("notes", &io::LogReport::notes)
      .def_readonly("faults", &io::LogReport::faults)
      .def_property_readonly("malformed_lines", &io::LogReport::malformed_lines);
}

}  // namespace

void AddLogs(py::module_& module) {
  AddLogOptions(module);
  AddReadings(module);
  AddReport(module);
  py::class_<io::LogReader>(module,
                            "LogReader",
                            "Reads a robot log message by message, in the order of the file, or "
                            "that of the stamps in a bag.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](io::LogReader& reader) {
             auto record = reader.Next();
             if (!record) throw py::stop_iteration();
             return *std::move(record);
           })
      .def_property_readonly("report", [](const io::LogReader& reader) { return reader.report(); });
  module.def(
      "read_log",
      [](const std::filesystem::path& path, const io::LogOptions& options) {
        return io::OpenLog(path, options);
      },
      py::arg("path"),
      py::arg("options") = io::LogOptions(),
      "Opens a log: CARMEN, Player or DP-SLAM text; plain, gzip, bzip2, xz or zstd; a bag of ROS "
      "1, or "
      "of rosbag2 as a file (.mcap, .db3) or a folder; or the journal of a service. All are "
      "recognised from the content. LogError says what is wrong with it, where, and how to mend "
      "it.");
}

}  // namespace qwsm::python
