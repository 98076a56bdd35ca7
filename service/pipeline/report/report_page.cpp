// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/report/report_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>

#include "service/io/files/atomic_file.hpp"

namespace qwsm::pipeline {

namespace {

/// A part of the page, from service/pipeline/report/page.
struct PagePart {
  std::string_view name;
  std::string_view text;
};

#define QWSM_FILE(file_name, file_text) PagePart{.name = file_name, .text = file_text},

constexpr auto kParts = std::to_array<PagePart>({
#include "report_files.inc"
});

#undef QWSM_FILE

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

/// All parts of a kind, one after the other.
std::string PartsThatEndIn(std::string_view ending) {
  std::string text;
  for (const PagePart& part : kParts) {
    if (part.name.ends_with(ending)) text += part.text;
  }
  return text;
}

/// The page with each `{{name}}` replaced; what is put in is not looked at again.
std::string Filled(std::string_view page, const std::map<std::string_view, std::string>& texts) {
  std::string filled;
  while (true) {
    const std::size_t hole = page.find("{{");
    filled += page.substr(0, hole);
    if (hole == std::string_view::npos) return filled;
    const std::size_t end = page.find("}}", hole);
    filled += texts.at(page.substr(hole + 2, end - hole - 2));
    page.remove_prefix(end + 2);
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
  return Filled(PartsThatEndIn(".html"),
                {{"style", PartsThatEndIn(".css")},
                 {"script", PartsThatEndIn(".js")},
                 {"title", Escaped(TitleText(title))},
                 {"data", WithoutTags(data.Line())}});
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
