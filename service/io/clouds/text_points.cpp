// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/text_points.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "service/io/files/file_error.hpp"
#include "service/io/files/line_reader.hpp"

namespace slam6d::io {
namespace {

bool IsSeparator(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ';';
}

/// The first line may say what follows: names of columns, or how many lines there are.
bool IsHeading(const qwsm::io::Line& line) {
  if (line.number != 1) return false;
  std::string_view text = line.text;
  const bool begins_with_number = NextNumber(text).has_value();
  return !begins_with_number || IsBlank(text);
}

}  // namespace

bool IsBlank(std::string_view text) { return std::ranges::all_of(text, IsSeparator); }

std::optional<double> NextNumber(std::string_view& text) {
  const auto* start = std::find_if_not(text.begin(), text.end(), IsSeparator);
  if (start != text.end() && *start == '+') ++start;
  double value = 0.0;
  const auto [end, error] = std::from_chars(start, text.end(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  if (end != text.end() && !IsSeparator(*end)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return value;
}

std::optional<Eigen::Vector3d> NextTriple(std::string_view& text) {
  const std::optional<double> x = NextNumber(text);
  const std::optional<double> y = x ? NextNumber(text) : std::nullopt;
  const std::optional<double> z = y ? NextNumber(text) : std::nullopt;
  if (!z) return std::nullopt;
  return Eigen::Vector3d(*x, *y, *z);
}

ScanPoints ReadTextPoints(
    const std::filesystem::path& file,
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& to_scanner) {
  std::ifstream stream = qwsm::io::OpenForReading(file);
  qwsm::io::LineReader lines{qwsm::io::ByteSource(stream)};
  ScanPoints points;
  try {
    while (const std::optional<qwsm::io::Line> line = lines.Next()) {
      if (IsBlank(line->text) || line->text.starts_with('#')) continue;
      std::string_view text = line->text;
      if (const std::optional<Eigen::Vector3d> triple = NextTriple(text)) {
        points.cloud.push_back(to_scanner(*triple));
      } else if (!IsHeading(*line)) {
        points.Skip(file.string() + ":" + std::to_string(line->number) +
                    ": expected three finite numbers 'x y z'");
      }
    }
  } catch (const std::runtime_error& error) {
    points.Skip(file.string() + ": " + error.what());
  }
  return points;
}

}  // namespace slam6d::io
