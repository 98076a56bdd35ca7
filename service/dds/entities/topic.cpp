// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/topic.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <cctype>

namespace qwsm::dds {
namespace {

std::string DdsTopicName(const std::string& ros_topic) {
  const bool is_valid = ros_topic.size() > 1 && ros_topic.front() == '/' &&
                        std::ranges::all_of(ros_topic, [](unsigned char c) {
                          return std::isalnum(c) != 0 || c == '_' || c == '/';
                        });
  if (!is_valid) {
    throw DdsError("topic '" + ros_topic +
                   "': must begin with / and have letters, digits, _ and / only");
  }
  // The ROS graph stands beside ROS topics, not among them.
  return ros_topic == "/ros_discovery_info" ? "ros_discovery_info" : "rt" + ros_topic;
}

}  // namespace

Entity MakeTopic(const Participant& participant,
                 const dds_topic_descriptor_t& descriptor,
                 const std::string& topic) {
  const std::string name = DdsTopicName(topic);
  return {dds_create_topic(participant.handle(), &descriptor, name.c_str(), nullptr, nullptr),
          topic};
}

}  // namespace qwsm::dds
