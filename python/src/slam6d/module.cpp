// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "python/src/slam6d/bindings.hpp"
#include "qwsm/version.hpp"
#include "service/config/problem.hpp"

PYBIND11_MODULE(_slam6d, module) {
  module.attr("__version__") = qwsm::kVersion;
  // Of this module alone: the module qwsm has one of its own for the same C++ exception.
  pybind11::register_local_exception<qwsm::config::ConfigError>(
      module, "OptionError", PyExc_ValueError);
  slam6d::python::AddRegistration(module);
}
