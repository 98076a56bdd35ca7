// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectories/graph_file.hpp"

#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/number_text.hpp"

namespace qwsm::io {
namespace {

void Append(std::string& line, const Pose2& pose) {
  for (const double number : {pose.x_m, pose.y_m, pose.theta_rad}) {
    line += ' ';
    AppendNumber(line, number);
  }
}

}  // namespace

void WriteG2oFile(const std::filesystem::path& path, const PoseGraph& graph) {
  AtomicFile file(path);
  for (std::size_t node = 0; node < graph.T_map_node.size(); ++node) {
    std::string line = "VERTEX_SE2 " + std::to_string(node);
    Append(line, graph.T_map_node[node]);
    file.stream() << line << '\n';
  }
  if (!graph.T_map_node.empty()) file.stream() << "FIX 0\n";
  for (const PoseEdge& edge : graph.edges) {
    std::string line = "EDGE_SE2 " + std::to_string(edge.from) + ' ' + std::to_string(edge.to);
    Append(line, edge.T_from_to);
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        line += ' ';
        AppendNumber(line, edge.information(i, j));
      }
    }
    file.stream() << line << '\n';
  }
  file.Commit();
}

}  // namespace qwsm::io
