// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/robot_names.hpp"

#include "service/team/scans/robot_name.hpp"

namespace qwsm::dds {

RobotNames::RobotNames(std::string_view name) {
  while (name.starts_with('/')) name.remove_prefix(1);
  while (name.ends_with('/')) name.remove_suffix(1);
  name_ = name;
}

std::optional<std::string> RobotNames::RobotOf(std::string_view dds_topic, std::string_view part) {
  constexpr std::string_view kRosTopic = "rt/";
  if (!dds_topic.starts_with(kRosTopic)) return std::nullopt;
  std::string_view rest = dds_topic.substr(kRosTopic.size());
  if (!rest.ends_with(part)) return std::nullopt;
  rest.remove_suffix(part.size());
  if (rest.empty()) return std::string();
  if (!rest.ends_with('/')) return std::nullopt;  // `rt/myscan` is another topic.
  rest.remove_suffix(1);
  return team::IsRobotName(rest) ? std::optional(std::string(rest)) : std::nullopt;
}

std::string RobotNames::Topic(std::string_view part) const {
  return (name_.empty() ? "/" : "/" + name_ + "/").append(part);
}

std::string RobotNames::Frame(std::string_view part) const {
  return (name_.empty() ? "" : name_ + "/").append(part);
}

}  // namespace qwsm::dds
