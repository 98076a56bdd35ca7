// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "qwsm/graph/pose_graph.hpp"

namespace qwsm::io {

/// Writes a graph in the format of g2o (VERTEX_SE2, EDGE_SE2), its first node fixed, for whoever
/// wants to go on with it. Its edges weigh there as they do here.
/// @throws WriteError where it cannot be written.
void WriteG2oFile(const std::filesystem::path& path, const PoseGraph& graph);

/// Writes a graph in the format of TORO (VERTEX2, EDGE2), which Karto's kin and MATLAB read, too.
/// @throws WriteError where it cannot be written.
void WriteToroFile(const std::filesystem::path& path, const PoseGraph& graph);

}  // namespace qwsm::io
