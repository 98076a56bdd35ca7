// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/published_topic.hpp"

namespace qwsm::dds {

std::optional<std::string> RosTopicOf(std::string_view dds_topic) {
  constexpr std::string_view kRosPrefix = "rt/";
  if (!dds_topic.starts_with(kRosPrefix)) return std::nullopt;
  return std::string(dds_topic.substr(kRosPrefix.size() - 1));
}

std::string RosTypeOf(std::string_view dds_type) {
  constexpr std::string_view kMangled = "dds_::";
  std::string name(dds_type);
  if (const std::size_t at = name.find(kMangled); at != std::string::npos) {
    name.erase(at, kMangled.size());
    if (name.ends_with('_')) name.pop_back();
  }
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::")) {
    name.replace(at, 2, 1, '/');
  }
  return name;
}

}  // namespace qwsm::dds
