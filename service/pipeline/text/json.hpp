// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace qwsm::pipeline {

/// A value of JSON that is built up and written.
///
/// It keeps nlohmann's headers to one source: they take seconds to compile wherever they are seen.
class Json {
 public:
  Json() = default;  ///< null
  Json(bool value);
  Json(double value);            ///< null where it is not finite, which JSON knows no word for.
  Json(std::string_view value);  ///< UTF-8; what is not is written as U+FFFD.
  Json(const std::string& value) : Json(std::string_view(value)) {}
  Json(const char* value) : Json(std::string_view(value)) {}
  template <std::integral Integer>
  Json(Integer value) : scalar_(std::to_string(value)) {}

  static Json Array();

  /// A member of an object, which null becomes; added, as null, where there is none of the name.
  /// Members are written in the order in which they were added.
  Json& operator[](std::string_view name);

  /// Adds to the end of an array, which null becomes.
  void Add(Json value);

  /// The value on lines of its own, for files and people.
  std::string Text() const;

  /// The value on one line, for programs that read one after the other.
  std::string Line() const;

 private:
  enum class Kind { kScalar, kArray, kObject };
  struct Layout {
    int indent = 0;             ///< Spaces per level.
    bool breaks_lines = false;  ///< Before every item.
  };

  void AppendTo(std::string& text, const Layout& layout, int depth) const;

  Kind kind_ = Kind::kScalar;
  std::string scalar_ = "null";     // As it is written.
  std::vector<std::string> names_;  // Of an object's values.
  std::vector<Json> values_;
};

}  // namespace qwsm::pipeline
