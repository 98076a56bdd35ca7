// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/uos_scan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace slam6d::io {
namespace {

constexpr double kMetresPerCentimetre = 0.01;

std::string ReadText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be opened");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) throw std::runtime_error(file.string() + ": cannot be read");
  return std::move(text).str();
}

/// Cuts the next line off the text; an end of line may be \n or \r\n.
std::string_view NextLine(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }

/// Cuts the next finite number off the text; nothing when there is none.
std::optional<double> NextNumber(std::string_view& text) {
  const auto* start = std::find_if_not(text.begin(), text.end(), IsBlank);
  if (start != text.end() && *start == '+') ++start;
  double value = 0.0;
  const auto [end, error] = std::from_chars(start, text.end(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
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

/// Axes of the left-handed frame (right, up, forward) in ours (forward, left, up): a mirror.
Eigen::Matrix3d OursFromUos() {
  return Eigen::Matrix3d{{0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
}

}  // namespace

UosPoints ReadUosPoints(const std::filesystem::path& file) {
  const std::string content = ReadText(file);
  UosPoints result;
  std::string_view text = content;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = NextLine(text);
    if (std::all_of(line.begin(), line.end(), IsBlank) || line.starts_with('#')) continue;
    if (const std::optional<Eigen::Vector3d> right_up_forward_cm = NextTriple(line)) {
      result.cloud.push_back(kMetresPerCentimetre * (OursFromUos() * *right_up_forward_cm));
    } else if (++result.skipped_lines == 1) {
      result.first_problem =
          file.string() + ":" + std::to_string(line_number) + ": expected three numbers 'x y z'";
    }
  }
  return result;
}

Pose3 ReadUosPose(const std::filesystem::path& file) {
  const std::string content = ReadText(file);
  std::string_view text = content;
  const std::optional<Eigen::Vector3d> position_cm = NextTriple(text);
  if (!position_cm) throw std::runtime_error(file.string() + ":1: expected a position 'x y z'");
  const std::optional<Eigen::Vector3d> angles_deg = NextTriple(text);
  if (!angles_deg) {
    throw std::runtime_error(file.string() + ":2: expected three angles in degrees");
  }
  const Eigen::Vector3d angles_rad = *angles_deg * (std::numbers::pi / 180.0);
  const Eigen::Matrix3d R_uos = (Eigen::AngleAxisd(angles_rad.x(), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(angles_rad.y(), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(angles_rad.z(), Eigen::Vector3d::UnitZ()))
                                    .toRotationMatrix();
  const Eigen::Matrix3d mirror = OursFromUos();
  return {.rotation = mirror * R_uos * mirror.transpose(),
          .translation_m = kMetresPerCentimetre * (mirror * *position_cm)};
}

std::vector<std::string> ListUosScans(const std::filesystem::path& folder) {
  std::vector<std::string> numbers;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".3d" && stem.starts_with("scan")) {
      numbers.push_back(stem.substr(4));
    }
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace slam6d::io
