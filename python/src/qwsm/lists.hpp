// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/stl.h>

#include <vector>

#include "qwsm/metrics/relations.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

// Classes of their own in Python: else each would be copied into a list wherever it is handed over.
PYBIND11_MAKE_OPAQUE(qwsm::Trajectory);
PYBIND11_MAKE_OPAQUE(std::vector<qwsm::Relation>);
