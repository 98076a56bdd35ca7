// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/relations_file.hpp"

#include <fstream>
#include <istream>

#include "service/io/field_reader.hpp"
#include "service/io/file_error.hpp"
#include "service/io/line_reader.hpp"

namespace qwsm::io {

std::vector<Relation> ReadRelations(std::istream& stream, std::string_view name) {
  std::vector<Relation> relations;
  LineReader lines{ByteSource(stream)};
  while (const std::optional<Line> line = lines.Next()) {
    FieldReader fields(line->text);
    if (fields.AtEnd() || line->text.starts_with('#')) continue;
    Relation relation;
    relation.first = fields.Stamp();
    relation.second = fields.Stamp();
    relation.T_first_second.x_m = fields.Number();
    relation.T_first_second.y_m = fields.Number();
    fields.Skip(3);  // Height, roll, pitch.
    relation.T_first_second.theta_rad = NormalizeAngle(fields.Number());
    if (!fields.fault()) relations.push_back(relation);
    if (fields.fault()) {
      ThrowAtLine(name, line->number, *fields.fault(), "a line is 't1 t2 x y z roll pitch yaw'");
    }
  }
  return relations;
}

std::vector<Relation> ReadRelationsFile(const std::filesystem::path& path) {
  std::ifstream file = OpenForReading(path);
  return ReadRelations(file, path.string());
}

}  // namespace qwsm::io
