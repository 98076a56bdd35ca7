// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectories/graph_file.hpp"

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>

#include "qwsm/geometry/along_axes.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/number_text.hpp"

namespace qwsm::io {
namespace {

/// A place in the information matrix.
struct Entry {
  int row;
  int column;
};

/// Along whose axes the translation of an edge's information is, where the edge is right.
enum class Axes { kFrom, kTo };

/// What a format calls nodes and edges, and how it lists the information of an edge.
struct GraphFormat {
  std::string_view vertex;
  std::string_view edge;
  std::array<Entry, 6> information;
  Axes axes;
};

// The error of an edge is T_from_to^-1 * T_from * T_to in g2o, along the axes of `to`. TORO turns
// information into the map by the heading of `from`.
constexpr GraphFormat kG2o{.vertex = "VERTEX_SE2",
                           .edge = "EDGE_SE2",
                           .information = {{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}},
                           .axes = Axes::kTo};
constexpr GraphFormat kToro{.vertex = "VERTEX2",
                            .edge = "EDGE2",
                            .information = {{{0, 0}, {0, 1}, {1, 1}, {2, 2}, {0, 2}, {1, 2}}},
                            .axes = Axes::kFrom};

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

Eigen::Matrix3d InformationAlong(Axes axes, const PoseEdge& edge) {
  return axes == Axes::kFrom ? edge.information : AlongAxesOf(edge.T_from_to, edge.information);
}

void WriteEdges(std::ostream& stream, const GraphFormat& format, const PoseGraph& graph) {
  for (const PoseEdge& edge : graph.edges) {
    std::string line =
        std::string(format.edge) + ' ' + std::to_string(edge.from) + ' ' + std::to_string(edge.to);
    Append(line, edge.T_from_to);
    const Eigen::Matrix3d information = InformationAlong(format.axes, edge);
    for (const auto& [row, column] : format.information) {
      line += ' ';
      AppendNumber(line, information(row, column));
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
