// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/rescue/points_of_interest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <istream>
#include <optional>
#include <stdexcept>

#include "qwsm/geometry/position.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/file_error.hpp"

namespace qwsm::io {
namespace {

using Fields = std::vector<std::string>;

constexpr std::size_t kLongestLine = 10'000;

/// Says where in a list something is wrong.
class InterestError : public std::runtime_error {
 public:
  InterestError(std::string_view name, std::size_t line, const std::string& what)
      : std::runtime_error(fmt::format("{}:{}: {}", name, line, what)) {}
};

std::string Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlank) + 1 - first));
}

/// The fields of a line; quotes keep commas together, and a doubled quote is one. Nothing where a
/// quote is not closed.
std::optional<Fields> SplitAtCommas(std::string_view line) {
  Fields fields{""};
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[i++];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (is_quoted) return std::nullopt;
  std::ranges::transform(fields, fields.begin(), Trimmed);
  return fields;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return lower;
}

/// Reads a list line by line.
class InterestReader {
 public:
  InterestReader(std::istream& stream, std::string_view name) : stream_(stream), name_(name) {}

  std::vector<PointOfInterest> Read() {
    ReadColumns();
    std::vector<PointOfInterest> points;
    while (NextLine()) {
      const Fields fields = FieldsOfLine();
      if (fields.size() != columns_.size()) {
        Fail(
            fmt::format("has {} fields, but {} columns are named", fields.size(), columns_.size()));
      }
      points.push_back(PointOf(fields, points.size() + 1));
    }
    return points;
  }

 private:
  /// Goes to the next line that holds something.
  bool NextLine() {
    while (std::getline(stream_, line_)) {
      ++number_;
      if (line_.size() > kLongestLine || line_.find('\0') != std::string::npos) {
        Fail("is no line of text; a list of points of interest is a table with commas");
      }
      if (!Trimmed(line_).empty()) return true;
    }
    return false;
  }

  Fields FieldsOfLine() const {
    std::optional<Fields> fields = SplitAtCommas(line_);
    if (!fields) Fail("a quote is not closed");
    return *std::move(fields);
  }

  void ReadColumns() {
    while (NextLine()) {
      columns_ = FieldsOfLine();
      std::ranges::transform(columns_, columns_.begin(), LowerCase);
      const auto has = [&](const char* name) { return std::ranges::count(columns_, name) == 1; };
      if (has("x") && has("y") && has("type")) return;
    }
    Fail("no line names the columns x, y and type, as in 'id,time,text,x,y,z,robot,mode,type'");
  }

  PointOfInterest PointOf(const Fields& fields, std::size_t number) const {
    PointOfInterest point;
    const auto take = [&](const char* name, std::string& text) {
      const auto column = std::ranges::find(columns_, name);
      if (column == columns_.end()) return;
      const std::string& field = fields[static_cast<std::size_t>(column - columns_.begin())];
      if (!field.empty()) text = field;
    };
    point.id = std::to_string(number);
    take("id", point.id);
    take("time", point.time);
    take("text", point.text);
    take("robot", point.robot);
    take("mode", point.mode);
    take("type", point.type);
    const std::array names = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      std::string text = axis < 2 ? "" : "0";
      take(names[static_cast<std::size_t>(axis)], text);
      point.p_map_m[axis] = Coordinate(names[static_cast<std::size_t>(axis)], text);
    }
    return point;
  }

  double Coordinate(const char* column, const std::string& text) const {
    double value_m = 0.0;
    const char* const end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, value_m);
    const bool is_number = result.ec == std::errc() && result.ptr == end;
    if (!is_number || !(std::abs(value_m) <= kFarthestCoordinate_m)) {
      Fail(fmt::format("{} is to be a number of metres, not '{}'", column, text));
    }
    return value_m;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw InterestError(name_, number_, what);
  }

  std::istream& stream_;
  std::string name_;
  std::size_t number_ = 0;
  std::string line_;
  Fields columns_;
};

std::string QuotedField(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

/// A field as it is where nothing in it would be taken for something else.
std::string PlainField(const std::string& text) {
  return text.find_first_of(",\"\r\n") == std::string::npos ? text : QuotedField(text);
}

}  // namespace

InterestKind KindOf(std::string_view type) {
  const std::string lower = LowerCase(type);
  for (const std::string_view name : {"v", "victim", "doll", "human", "person", "real_vic"}) {
    if (lower == name) return InterestKind::kVictim;
  }
  for (const std::string_view name : {"hazard", "hazmat", "hazmat_sign", "fire", "gas"}) {
    if (lower == name) return InterestKind::kHazard;
  }
  return InterestKind::kObject;
}

std::vector<PointOfInterest> ReadPointsOfInterest(std::istream& stream, std::string_view name) {
  return InterestReader(stream, name).Read();
}

std::vector<PointOfInterest> ReadPointsOfInterest(const std::filesystem::path& path) {
  std::ifstream stream = OpenForReading(path);
  return ReadPointsOfInterest(stream, path.string());
}

void WritePointsOfInterest(const std::filesystem::path& path,
                           const MissionTitle& title,
                           std::span<const PointOfInterest> points) {
  std::string text;
  for (const std::string_view line : {std::string_view("pois"),
                                      std::string_view("1.2"),
                                      std::string_view(title.team),
                                      std::string_view(title.country),
                                      std::string_view(title.date),
                                      std::string_view(title.time),
                                      std::string_view(title.mission)}) {
    text += QuotedField(line) + "\n";
  }
  text += "\nid,time,text,x,y,z,robot,mode,type\n";
  for (const PointOfInterest& point : points) {
    text += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{},{},{}\n",
                        PlainField(point.id),
                        PlainField(point.time),
                        QuotedField(point.text),
                        point.p_map_m.x(),
                        point.p_map_m.y(),
                        point.p_map_m.z(),
                        PlainField(point.robot),
                        PlainField(point.mode),
                        PlainField(point.type));
  }
  WriteTextFile(path, text);
}

}  // namespace qwsm::io
