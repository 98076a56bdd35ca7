// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace qwsm::config {

struct YamlEntry;

/// A piece of a YAML document and where it begins.
struct YamlNode {
  enum class Kind { kNothing, kPlain, kQuoted, kSequence, kMap };
  Kind kind = Kind::kNothing;
  int line = 1;      ///< Counted from 1.
  int column = 1;    ///< Counted from 1.
  std::string text;  ///< The text of a scalar.
  /// Entries of a map, in the order of the file, duplicates included.
  std::vector<YamlEntry> entries;
  std::vector<YamlNode> items;  ///< Items of a sequence.
};

struct YamlEntry {
  YamlNode key;
  YamlNode value;
};

/// Tells what is wrong with the syntax, and where.
class YamlError : public std::runtime_error {
 public:
  YamlError(const std::string& what, int line, int column)
      : std::runtime_error(what), line_(line), column_(column) {}
  int line() const { return line_; }
  int column() const { return column_; }

 private:
  int line_;
  int column_;
};

/// Reads one document. Options need maps, lists and scalars only, so what could make a small
/// file large (anchors and aliases), deep (over 32 levels) or surprising (tags, a second document)
/// is refused. @throws YamlError
YamlNode ParseYaml(const std::string& text);

}  // namespace qwsm::config
