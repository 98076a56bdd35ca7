// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/eigen.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <string>
#include <vector>

#include "python/src/arrays.hpp"
#include "python/src/option_dict.hpp"
#include "python/src/qwsm/bindings.hpp"
#include "python/src/qwsm/lists.hpp"
#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/mapping/mapper.hpp"
#include "service/pipeline/run/log_source.hpp"
#include "service/pipeline/run/parallel.hpp"

namespace qwsm::python {
namespace {

/// What mapping a log leaves.
struct MappedLog {
  Trajectory live;                        // As answered.
  Trajectory trajectory;                  // Corrected, where that was wanted.
  std::vector<UncertainPose2> map_robot;  // As in `trajectory`.
  std::vector<std::string> status;
  std::vector<Loop> loops;
  std::vector<std::string> notes;
  ScanMap map;
};

/// Lets Ctrl-C end a long loop that runs without the interpreter's lock.
void HandleSignals() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void WarnInPython(const std::string& what) {
  const py::gil_scoped_acquire gil;
  if (PyErr_WarnEx(PyExc_UserWarning, what.c_str(), 1) != 0) throw py::error_already_set();
}

void Append(const MappingStep& step, MappedLog& mapped) {
  mapped.live.push_back({.stamp = step.stamp, .T_map_robot = step.map_robot.T_a_b});
  mapped.map_robot.push_back(step.map_robot);
  mapped.status.emplace_back(Name(step.status));
}

void Correct(SelfCorrectingMapper& mapper, const ScanMapOptions& options, MappedLog& mapped) {
  FinishedDrive finished = mapper.Finish();
  mapped.map = MapOf(std::move(finished.scans), options);
  mapped.map_robot = std::move(finished.correction.map_robot);
  mapped.loops = std::move(finished.correction.loops);
}

MappedLog MapScans(pipeline::LogSource& source, const MapperOptions& options, bool correct) {
  constexpr std::size_t kScansBetweenSignals = 64;
  Mapper incremental(options);
  SelfCorrectingMapper correcting(options, pipeline::BeginOnAnotherThread);
  MappedLog mapped;
  while (const std::optional<Observation> observation = source.Next()) {
    Append(correct ? correcting.Process(*observation) : incremental.Process(*observation), mapped);
    if (mapped.live.size() % kScansBetweenSignals == 0) HandleSignals();
  }
  if (correct) {
    Correct(correcting, options.map, mapped);
  } else {
    mapped.map = incremental.map();
  }
  mapped.trajectory = mapped.live;
  for (std::size_t i = 0; i < mapped.live.size(); ++i) {
    mapped.trajectory[i].T_map_robot = mapped.map_robot[i].T_a_b;
  }
  mapped.notes = source.Describe();
  return mapped;
}

MappedLog MapLogs(const std::vector<std::filesystem::path>& logs,
                  const py::dict& options,
                  io::LogOptions log_options,
                  bool correct,
                  bool mirrored) {
  const auto mapper_options = OptionsFrom<MapperOptions>(options);
  const bool corrects = correct && mapper_options.matcher == MatcherKind::kQWsm;
  log_options.on_fault = WarnInPython;
  log_options.mirrored = mirrored;
  const py::gil_scoped_release without_gil;
  pipeline::LogSource source(logs, log_options);
  return MapScans(source, mapper_options, corrects);
}

MappedLog MapLog(const std::filesystem::path& log,
                 const py::dict& options,
                 const io::LogOptions& log_options,
                 bool correct,
                 bool mirrored) {
  return MapLogs({log}, options, log_options, correct, mirrored);
}

py::array CovariancesOf(const py::object& self) {
  const auto& poses = self.cast<const MappedLog&>().map_robot;
  return ViewOf(poses, poses.empty() ? nullptr : poses[0].covariance.data(), {3, 3}, self);
}

void AddLoop(py::module_& module) {
  py::class_<Loop>(module, "Loop", "A scan that was matched with a submap of an earlier pass.")
      .def_property_readonly("from_scan", [](const Loop& loop) { return loop.edge.from; })
      .def_property_readonly("to_scan", [](const Loop& loop) { return loop.edge.to; })
      .def_property_readonly("T_from_to", [](const Loop& loop) { return loop.edge.T_from_to; })
      .def_property_readonly("verdict",
                             [](const Loop& loop) { return std::string(Name(loop.verdict)); })
      .def_readonly("overlap", &Loop::overlap)
      .def_readonly("reduced_chi2", &Loop::reduced_chi2);
}

constexpr const char* kMapLog =
    "Maps a log, or several as parts of one recording, as `qwsm map` does, and corrects path and "
    "map "
    "where places are seen again.\n\n"
    "options: as under `mapper` in the program's configuration. log: how it is read. correct: "
    "False "
    "leaves the path as it was answered. mirrored: the laser is upside down or counts its beams "
    "from "
    "the other side. What is wrong with a log but can be read around is told as a UserWarning, "
    "else "
    "LogError is raised. Other threads run meanwhile; Ctrl-C ends it.";

template <class Function>
void DefineMapLog(py::module_& module, Function function) {
  module.def("map_log",
             function,
             py::arg("path"),
             py::arg("options") = py::dict(),
             py::kw_only(),
             py::arg("log") = io::LogOptions(),
             py::arg("correct") = true,
             py::arg("mirrored") = false,
             kMapLog);
}

}  // namespace

void AddMappedLog(py::module_& module) {
  AddLoop(module);
  py::class_<MappedLog>(module, "MappedLog", "What mapping a log leaves.")
      .def_readonly("trajectory", &MappedLog::trajectory, "The path, corrected where loops closed.")
      .def_readonly("live", &MappedLog::live, "The path as it was answered, scan by scan.")
      .def_property_readonly(
          "covariances",
          &CovariancesOf,
          "Covariances of (x, y, theta) of the trajectory's poses: (n, 3, 3), a view.")
      .def_readonly(
          "status", &MappedLog::status, "Where each pose comes from, as MappingStep.status.")
      .def_readonly("loops", &MappedLog::loops, "All loops that were found, accepted or not.")
      .def_readonly("notes", &MappedLog::notes, "What was found in the log, in lines for people.")
      .def_readonly("map", &MappedLog::map);
  DefineMapLog(module, &MapLog);
  DefineMapLog(module, &MapLogs);
}

}  // namespace qwsm::python
