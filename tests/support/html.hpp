// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace qwsm::test {

/// What is wrong with the nesting of a page's tags; empty where every element is closed in its
/// turn. What stands in elements `script` and `style` is no HTML and is passed over, as browsers
/// do.
inline std::string NestingFault(std::string page) {
  const auto without = [&](const char* from, const std::string& to) {
    for (std::size_t begin = 0; (begin = page.find(from, begin)) != std::string::npos;) {
      const std::size_t text = page.find('>', begin) + 1;
      page.erase(text, page.find(to, text) - text);
      begin = text;
    }
  };
  without("<script", "</script>");
  without("<style", "</style>");
  std::vector<std::string> open;
  const std::regex tag(
      "<!--[^]*?-->|<!DOCTYPE[^>]*>|<(/?)([a-z0-9]+)((?:[^>\"]|\"[^\"]*\")*?)(/?)>");
  for (std::sregex_iterator at(page.begin(), page.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if (name.empty() || (*at)[4] == "/") continue;
    if ((*at)[1] != "/") {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is not closed";
}

}  // namespace qwsm::test
