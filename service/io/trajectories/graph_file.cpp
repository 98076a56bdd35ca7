// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectories/graph_file.hpp"

#include <array>
#include <string>
#include <string_view>

#include "service/io/files/atomic_file.hpp"
#include "service/io/files/number_text.hpp"

namespace qwsm::io {
namespace {

/// A place in the information matrix.
struct Entry {
  int row;
  int column;
};

/// What a format calls nodes and edges, and in which order it lists the information of an edge.
struct GraphFormat {
  std::string_view vertex;
  std::string_view edge;
  std::array<Entry, 6> information;
};

constexpr GraphFormat kG2o{.vertex = "VERTEX_SE2",
                           .edge = "EDGE_SE2",
                           .information = {{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}}};
constexpr GraphFormat kToro{.vertex = "VERTEX2",
                            .edge = "EDGE2",
                            .information = {{{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}}}};

void Append(std::string& line, const Pose2& pose) {
  for (const double number : {pose.x_m, pose.y_m, pose.theta_rad}) {
    line += ' ';
    AppendNumber(line, number);
  }
}

void WriteNodes(std::ostream& stream, const GraphFormat& format, const PoseGraph& graph) {
  for (std::size_t node = 0; node < graph.T_map_node.size(); ++node) {
    std::string line = std::string(format.vertex) + ' ' + std::to_string(node);
    Append(line, graph.T_map_node[node]);
    stream << line << '\n';
  }
}

void WriteEdges(std::ostream& stream, const GraphFormat& format, const PoseGraph& graph) {
  for (const PoseEdge& edge : graph.edges) {
    std::string line =
        std::string(format.edge) + ' ' + std::to_string(edge.from) + ' ' + std::to_string(edge.to);
    Append(line, edge.T_from_to);
    for (const auto& [row, column] : format.information) {
      line += ' ';
      AppendNumber(line, edge.information(row, column));
    }
    stream << line << '\n';
  }
}

}  // namespace

void WriteG2oFile(const std::filesystem::path& path, const PoseGraph& graph) {
  AtomicFile file(path);
  WriteNodes(file.stream(), kG2o, graph);
  if (!graph.T_map_node.empty()) file.stream() << "FIX 0\n";
  WriteEdges(file.stream(), kG2o, graph);
  file.Commit();
}

void WriteToroFile(const std::filesystem::path& path, const PoseGraph& graph) {
  AtomicFile file(path);
  WriteNodes(file.stream(), kToro, graph);
  WriteEdges(file.stream(), kToro, graph);
  file.Commit();
}

}  // namespace qwsm::io
