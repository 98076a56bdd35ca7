// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string_view>

#include "service/io/files/field_reader.hpp"

namespace qwsm::io {

/// Reads text in columns, plain or compressed: hands each line to `read_row`, but empty ones and
/// comments, which begin with `#`.
///
/// @param name stands for the stream in messages
/// @param columns what a line is to be: "a line is 't x y'"
/// @throws std::runtime_error "name:line: what is wrong; columns" at the first line in which a
/// fault
///         was met, which `read_row` need not look for; "name: ..." where the stream cannot be read
///         on
void ReadTable(std::istream& stream,
               std::string_view name,
               std::string_view columns,
               const std::function<void(FieldReader&)>& read_row);

}  // namespace qwsm::io
