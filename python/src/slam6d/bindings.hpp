// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace slam6d::python {

/// Adds clouds, their files, and registration to the module.
void AddRegistration(pybind11::module_& module);

}  // namespace slam6d::python
