// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/trajectories/relations_file.hpp"

#include <fstream>

#include "service/io/files/file_error.hpp"
#include "service/io/files/table_file.hpp"

namespace qwsm::io {

std::vector<Relation> ReadRelations(std::istream& stream, std::string_view name) {
  std::vector<Relation> relations;
  ReadTable(stream, name, "a line is 't1 t2 x y z roll pitch yaw'", [&](FieldReader& fields) {
    Relation& relation = relations.emplace_back();
    relation.first = fields.Stamp();
    relation.second = fields.Stamp();
    relation.T_first_second.x_m = fields.Coordinate();
    relation.T_first_second.y_m = fields.Coordinate();
    fields.Skip(3);  // Height, roll, pitch.
    relation.T_first_second.theta_rad = NormalizeAngle(fields.Number());
  });
  return relations;
}

std::vector<Relation> ReadRelationsFile(const std::filesystem::path& path) {
  std::ifstream file = OpenForReading(path);
  return ReadRelations(file, path.string());
}

}  // namespace qwsm::io
