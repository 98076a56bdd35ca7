// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "python/src/qwsm/bindings.hpp"
#include "qwsm/logs/log_reader.hpp"
#include "qwsm/version.hpp"
#include "service/config/problem.hpp"
#include "service/io/maps/map_file.hpp"

namespace {

// Of this module alone: the module slam6d, too, has an OptionError for the same C++ exception, and
// the one imported last would else be raised by both.
void AddErrors(pybind11::module_& module) {
  using pybind11::register_local_exception;
  register_local_exception<qwsm::io::LogError>(module, "LogError", PyExc_ValueError);
  register_local_exception<qwsm::io::MapFileError>(module, "MapFileError", PyExc_ValueError);
  register_local_exception<qwsm::config::ConfigError>(module, "OptionError", PyExc_ValueError);
}

}  // namespace

PYBIND11_MODULE(_qwsm, module) {
  module.attr("__version__") = qwsm::kVersion;
  AddErrors(module);
  qwsm::python::AddGeometry(module);
  qwsm::python::AddMatching(module);
  qwsm::python::AddQuadtree(module);
  qwsm::python::AddLogs(module);
  qwsm::python::AddScanMap(module);
  qwsm::python::AddMapper(module);
  qwsm::python::AddMetrics(module);
  qwsm::python::AddMappedLog(module);
}
