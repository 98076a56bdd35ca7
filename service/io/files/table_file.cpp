// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/table_file.hpp"

#include <istream>
#include <optional>
#include <stdexcept>
#include <string>

#include "service/io/files/line_reader.hpp"

namespace qwsm::io {
namespace {

std::optional<FieldFault> FaultOf(const Line& line,
                                  const std::function<void(FieldReader&)>& read_row) {
  if (line.too_long) return FieldFault::kTooLong;
  FieldReader fields(line.text);
  if (fields.AtEnd() || line.text.starts_with('#')) return std::nullopt;
  read_row(fields);
  fields.ExpectEnd();
  return fields.fault();
}

}  // namespace

void ReadTable(std::istream& stream,
               std::string_view name,
               std::string_view columns,
               const std::function<void(FieldReader&)>& read_row) {
  LineReader lines{ByteSource(stream)};
  std::string message(name);
  while (true) {
    std::optional<Line> line;
    try {
      line = lines.Next();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(message.append(": ").append(error.what()));
    }
    if (!line) return;
    if (const std::optional<FieldFault> fault = FaultOf(*line, read_row)) {
      message.append(":").append(std::to_string(line->number)).append(": ");
      throw std::runtime_error(message.append(Explain(*fault)).append("; ").append(columns));
    }
  }
}

}  // namespace qwsm::io
