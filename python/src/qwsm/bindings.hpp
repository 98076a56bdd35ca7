// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace qwsm::python {

// Each adds what it is named after to the module. The order is that of module.cpp: what one takes
// or returns is added before it.
void AddGeometry(pybind11::module_& module);
void AddMatching(pybind11::module_& module);
void AddQuadtree(pybind11::module_& module);
void AddLogs(pybind11::module_& module);
void AddScanMap(pybind11::module_& module);
void AddMapper(pybind11::module_& module);
void AddMetrics(pybind11::module_& module);
void AddMappedLog(pybind11::module_& module);

}  // namespace qwsm::python
