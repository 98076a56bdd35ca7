// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "service/io/files/atomic_file.hpp"

namespace qwsm::pipeline {

/// The page without title and data, embedded from service/pipeline/report/page.
extern const std::string_view kReportTemplate;

namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string TitleText(const RunTitle& title) {
  std::string text = title.command;
  for (const std::string& input : title.inputs) text += " " + input;
  return text;
}

/// Text that HTML shows as it is.
std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

/// JSON that may stand in an element `script`: nothing in it looks like a tag or a comment.
std::string WithoutTags(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      text += "\\u003c";
    } else {
      text += letter;
    }
  }
  return text;
}

/// The template with each `{{name}}` replaced; what is put in is not looked at again.
std::string Filled(std::string_view page, std::string_view title, std::string_view data) {
  std::string text;
  text.reserve(page.size() + title.size() + data.size());
  while (true) {
    const std::size_t hole = page.find("{{");
    text += page.substr(0, hole);
    if (hole == std::string_view::npos) return text;
    page.remove_prefix(hole);
    const std::size_t end = page.find("}}") + 2;
    text += page.substr(0, end) == "{{title}}" ? title : data;
    page.remove_prefix(end);
  }
}

}  // namespace

Json ReportData(const RunTitle& title) {
  Json data;
  data["command"] = title.command;
  data["version"] = title.version;
  data["inputs"] = Json::Array();
  for (const std::string& input : title.inputs) data["inputs"].Add(input);
  data["interrupted"] = title.interrupted;
  return data;
}

std::string ReportPage(const RunTitle& title, const Json& data) {
  return Filled(kReportTemplate, Escaped(TitleText(title)), WithoutTags(data.Line()));
}

void WriteReportPage(const std::filesystem::path& path, const RunTitle& title, const Json& data) {
  io::WriteTextFile(path, ReportPage(title, data));
}

std::string Base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kLetters[bits >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string Base64(std::span<const float> numbers) {
  std::string bytes;
  bytes.reserve(4 * numbers.size());
  for (const float number : numbers) {
    const auto bits = std::bit_cast<std::uint32_t>(number);
    for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift);
  }
  return Base64(std::string_view(bytes));
}

}  // namespace qwsm::pipeline
