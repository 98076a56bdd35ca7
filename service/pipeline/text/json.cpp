// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/text/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace qwsm::pipeline {
namespace {

std::string ScalarText(const nlohmann::json& scalar) {
  return scalar.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Json::Json(bool value) : scalar_(value ? "true" : "false") {}
Json::Json(double value) : scalar_(ScalarText(value)) {}
Json::Json(std::string_view value) : scalar_(ScalarText(value)) {}

Json Json::Array() {
  Json array;
  array.kind_ = Kind::kArray;
  return array;
}

Json& Json::operator[](std::string_view name) {
  kind_ = Kind::kObject;
  const auto found = std::ranges::find(names_, name);
  if (found != names_.end()) return values_[static_cast<std::size_t>(found - names_.begin())];
  names_.emplace_back(name);
  return values_.emplace_back();
}

void Json::Add(Json value) {
  kind_ = Kind::kArray;
  values_.push_back(std::move(value));
}

std::string Json::Text() const {
  std::string text;
  AppendTo(text, {.indent = 2, .breaks_lines = true}, 0);
  return text + '\n';
}

std::string Json::Line() const {
  std::string text;
  AppendTo(text, {}, 0);
  return text + '\n';
}

void Json::AppendTo(std::string& text, const Layout& layout, int depth) const {
  if (kind_ == Kind::kScalar) {
    text += scalar_;
    return;
  }
  const auto break_line = [&](int levels) {
    if (!layout.breaks_lines) return;
    text += '\n';
    text.append(static_cast<std::size_t>(levels * layout.indent), ' ');
  };
  text += kind_ == Kind::kArray ? '[' : '{';
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (i > 0) text += ',';
    break_line(depth + 1);
    if (kind_ == Kind::kObject) text += ScalarText(names_[i]) + (layout.breaks_lines ? ": " : ":");
    values_[i].AppendTo(text, layout, depth + 1);
  }
  if (!values_.empty()) break_line(depth);
  text += kind_ == Kind::kArray ? ']' : '}';
}

}  // namespace qwsm::pipeline
