// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/pcd_file.hpp"

#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "service/io/clouds/point_records.hpp"

namespace slam6d::io {
namespace {

/// The words behind each keyword, up to and with DATA.
using PcdHeader = std::map<std::string, std::vector<std::string>, std::less<>>;

PcdHeader ReadPcdHeader(RecordFile& file) {
  PcdHeader header;
  while (const std::optional<std::string_view> line = file.NextLine()) {
    std::istringstream words{std::string(*line)};
    std::string keyword;
    if (!(words >> keyword) || keyword.starts_with('#')) continue;
    std::vector<std::string>& values = header[keyword];
    for (std::string word; words >> word;) values.push_back(word);
    if (keyword == "DATA") return header;
  }
  file.Fail("no line 'DATA ascii' or 'DATA binary': this is no PCD file");
}

NumberType TypeOf(const RecordFile& file, const std::string& type, std::size_t size) {
  if (type == "F" && size == 4) return NumberType::kFloat32;
  if (type == "F" && size == 8) return NumberType::kFloat64;
  if (type == "I" && size == 1) return NumberType::kInt8;
  if (type == "I" && size == 2) return NumberType::kInt16;
  if (type == "I" && size == 4) return NumberType::kInt32;
  if (type == "I" && size == 8) return NumberType::kInt64;
  if (type == "U" && size == 1) return NumberType::kUint8;
  if (type == "U" && size == 2) return NumberType::kUint16;
  if (type == "U" && size == 4) return NumberType::kUint32;
  if (type == "U" && size == 8) return NumberType::kUint64;
  file.Fail("a field of TYPE " + type + " and SIZE " + std::to_string(size) + " is not read");
}

RecordLayout LayoutOf(const RecordFile& file, const PcdHeader& header) {
  const auto values = [&](const char* keyword) {
    const auto found = header.find(keyword);
    return found == header.end() ? std::vector<std::string>{} : found->second;
  };
  const std::vector<std::string> names = values("FIELDS");
  const std::vector<std::string> sizes = values("SIZE");
  const std::vector<std::string> types = values("TYPE");
  const std::vector<std::string> counts = values("COUNT");
  if (sizes.size() != names.size() || types.size() != names.size()) {
    file.Fail("FIELDS, SIZE and TYPE must have as many entries each");
  }
  RecordLayout layout;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t count = i < counts.size() ? file.Count(counts[i]) : 1;
    layout.Add(names[i], TypeOf(file, types[i], file.Count(sizes[i])), count);
  }
  layout.Check(file.path);
  return layout;
}

std::size_t CountOf(const RecordFile& file, const PcdHeader& header) {
  const auto number = [&](const char* keyword) -> std::optional<std::size_t> {
    const auto found = header.find(keyword);
    if (found == header.end() || found->second.empty()) return std::nullopt;
    return file.Count(found->second.front());
  };
  const std::optional<std::size_t> points = number("POINTS");
  const std::optional<std::size_t> width = number("WIDTH");
  if (points) return *points;
  if (!width) file.Fail("neither POINTS nor WIDTH in the header");
  return *width * number("HEIGHT").value_or(1);
}

}  // namespace

ScanPoints ReadPcd(const std::filesystem::path& path) {
  RecordFile file(path);
  const PcdHeader header = ReadPcdHeader(file);
  const std::vector<std::string>& data = header.at("DATA");
  const std::string encoding = data.empty() ? "" : data.front();
  const RecordLayout layout = LayoutOf(file, header);
  ScanPoints points;
  if (encoding == "ascii") {
    TakeText(file, layout, CountOf(file, header), points);
  } else if (encoding == "binary") {
    TakeBinary(file, layout, CountOf(file, header), points);
  } else {
    file.Fail("DATA " + encoding + " is not read; convert it with pcl_convert_pcd_ascii_binary");
  }
  return points;
}

}  // namespace slam6d::io
