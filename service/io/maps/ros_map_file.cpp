// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/maps/ros_map_file.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/geometry/position.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/field_reader.hpp"
#include "service/io/files/file_error.hpp"
#include "service/io/files/number_text.hpp"
#include "service/io/maps/pgm_file.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t kFreeGrey = 254;
constexpr std::uint8_t kOccupiedGrey = 0;
constexpr std::uint8_t kUnknownGrey = 205;

constexpr double kSmallestPixel_m = 1e-4;
constexpr double kLargestPixel_m = 1e4;

std::uint8_t GreyOf(CellState state) {
  switch (state) {
    case CellState::kFree:
      return kFreeGrey;
    case CellState::kOccupied:
      return kOccupiedGrey;
    case CellState::kUnknown:
      break;
  }
  return kUnknownGrey;
}

// A scalar that any YAML reader takes as the text it is.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') quoted += '\\';
    quoted += character;
  }
  return quoted + '"';
}

std::string Trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlank) + 1 - first));
}

// The scalar without its quotes and without the comment behind it.
std::string Unquoted(const std::string& text) {
  if (text.empty() || (text[0] != '"' && text[0] != '\'')) {
    const std::size_t comment = text[0] == '#' ? 0 : text.find(" #");
    return Trimmed(std::string_view(text).substr(0, comment));
  }
  std::string plain;
  for (std::size_t i = 1; i < text.size() && text[i] != text[0]; ++i) {
    if (text[i] == '\\' && text[0] == '"' && i + 1 < text.size()) ++i;
    plain += text[i];
  }
  return plain;
}

// The flat YAML that map servers write: `key: value`, where a value is a scalar, or a list in
// brackets or as lines that begin with a dash.
class MapHeader {
 public:
  explicit MapHeader(const fs::path& path) : path_(path) {
    std::ifstream file = OpenForReading(path);
    int number = 0;
    for (std::string line; std::getline(file, line);) ReadLine(Trimmed(line), ++number);
  }

  std::string Text(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) Fail("the key '" + key + "' is missing");
    return found->second;
  }
  std::string Text(const std::string& key, const std::string& otherwise) const {
    return values_.contains(key) ? values_.at(key) : otherwise;
  }

  double Number(const std::string& key) const { return ToNumber(key, Text(key)); }

  // A number, as map_server writes it, or a word, which nav2 takes as well.
  bool Flag(const std::string& key) const {
    const std::string text = Text(key);
    if (text == "true" || text == "false") return text == "true";
    return Number(key) != 0.0;
  }

  std::array<double, 3> Triple(const std::string& key) const {
    std::string text = Text(key);
    for (char& character : text) {
      if (character == '[' || character == ']' || character == ',') character = ' ';
    }
    FieldReader fields(text);
    const std::array<double, 3> triple = {fields.Number(), fields.Number(), fields.Number()};
    fields.ExpectEnd();
    if (fields.fault()) Fail(key + ": expected three numbers, got '" + Text(key) + "'");
    return triple;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw std::runtime_error(path_.string() + ": " + what);
  }

 private:
  void ReadLine(const std::string& line, int number) {
    if (line.empty() || line[0] == '#' || line.starts_with("---") || line[0] == '%') return;
    if (line.starts_with("- ") && !last_key_.empty()) {
      values_[last_key_] += Unquoted(Trimmed(line.substr(2))) + " ";
      return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) {
      Fail("line " + std::to_string(number) + ": expected 'key: value'");
    }
    last_key_ = Trimmed(line.substr(0, colon));
    values_[last_key_] = Unquoted(Trimmed(line.substr(colon + 1)));
  }

  double ToNumber(const std::string& key, const std::string& text) const {
    const std::optional<double> number = ParseNumber(text);
    if (!number || !std::isfinite(*number)) Fail(key + ": expected a number, got '" + text + "'");
    return *number;
  }

  fs::path path_;
  std::map<std::string, std::string> values_;
  std::string last_key_;
};

// What each of the 256 greys means, in the mode `trinary`.
std::array<CellState, 256> StatesOfGreys(const MapHeader& header) {
  const bool negate = header.Flag("negate");
  const double occupied_above = header.Number("occupied_thresh");
  const double free_below = header.Number("free_thresh");
  std::array<CellState, 256> states{};
  for (int grey = 0; grey < 256; ++grey) {
    const double occupancy = (negate ? grey : 255 - grey) / 255.0;
    states[static_cast<std::size_t>(grey)] = occupancy > occupied_above ? CellState::kOccupied
                                             : occupancy < free_below   ? CellState::kFree
                                                                        : CellState::kUnknown;
  }
  return states;
}

// From the picture's rows, which begin at the top, to the grid's, which begin at the bottom, and
// back.
template <class From, class To, class Convert>
std::vector<To> TurnedOver(const std::vector<From>& cells, int width, Convert convert) {
  std::vector<To> turned;
  turned.reserve(cells.size());
  for (auto row_end = cells.end(); row_end != cells.begin(); row_end -= width) {
    for (auto cell = row_end - width; cell != row_end; ++cell) turned.push_back(convert(*cell));
  }
  return turned;
}

}  // namespace

void WriteRosMap(const fs::path& path, const OccupancyGrid& grid) {
  fs::path image_path = path;
  image_path.replace_extension(".pgm");
  WritePgm(image_path,
           {.width_px = grid.width,
            .height_px = grid.height,
            .pixels = TurnedOver<CellState, std::uint8_t>(grid.cells, grid.width, GreyOf)});

  std::string text = "image: " + Quoted(image_path.filename().string()) + "\nmode: trinary\n";
  text += "resolution: ";
  AppendNumber(text, grid.cell_m);
  text += "\norigin: [";
  AppendNumber(text, grid.origin_map_m.x());
  text += ", ";
  AppendNumber(text, grid.origin_map_m.y());
  // Unknown cells are (255 - 205) / 255 = 0.19608: with the often seen 0.25 they would load as
  // free.
  text += ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  WriteTextFile(path, text);
}

OccupancyGrid ReadRosMap(const fs::path& path) {
  const MapHeader header(path);
  const std::string mode = header.Text("mode", "trinary");
  if (mode != "trinary") header.Fail("mode: only 'trinary' can be read, not '" + mode + "'");
  const double cell_m = header.Number("resolution");
  if (!(cell_m >= kSmallestPixel_m && cell_m <= kLargestPixel_m)) {
    header.Fail("resolution: must be between 0.0001 and 10000 m");
  }
  const auto [x_m, y_m, yaw_rad] = header.Triple("origin");
  if (!IsCoordinate(x_m) || !IsCoordinate(y_m)) {
    header.Fail("origin: is more than 10000 km away");
  }
  if (yaw_rad != 0.0) header.Fail("origin: a map that is turned cannot be read");

  const GreyImage image = ReadPgm(path.parent_path() / header.Text("image"));
  const std::array<CellState, 256> states = StatesOfGreys(header);
  const auto state_of = [&](std::uint8_t grey) { return states[grey]; };
  return {.cell_m = cell_m,
          .origin_map_m = {x_m, y_m},
          .width = image.width_px,
          .height = image.height_px,
          .cells = TurnedOver<std::uint8_t, CellState>(image.pixels, image.width_px, state_of)};
}

}  // namespace qwsm::io
