// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/bag_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace qwsm::io {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\n') {
      quoted += "\\n";
    } else if (c == '"' || c == '\\') {
      quoted += std::string("\\") + c;
    } else {
      quoted += c;
    }
  }
  return '"' + quoted + '"';
}

}  // namespace

void BagSummary::Count(std::size_t topic, Timestamp stamp) {
  ++topics[topic].messages;
  first = messages == 0 ? stamp : std::min(first, stamp);
  last = messages == 0 ? stamp : std::max(last, stamp);
  ++messages;
}

std::string QosOf(const TopicToWrite& topic) {
  constexpr std::string_view kForever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n  deadline:{}"
      "  lifespan:{}  liveliness: 1\n  liveliness_lease_duration:{}"
      "  avoid_ros_namespace_conventions: false",
      topic.is_latched ? 1 : 10,
      topic.is_latched ? 1 : 2,
      kForever,
      kForever,
      kForever);
}

std::string MetadataYaml(const BagSummary& summary,
                         std::string_view storage,
                         const std::string& file_name) {
  const auto start = summary.first.count();
  const auto duration = (summary.last - summary.first).count();
  std::string yaml = fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: {}\n"
      "  duration:\n    nanoseconds: {}\n  starting_time:\n    nanoseconds_since_epoch: {}\n"
      "  message_count: {}\n  topics_with_message_count:{}\n",
      storage,
      duration,
      start,
      summary.messages,
      summary.topics.empty() ? " []" : "");
  for (const BagSummary::Topic& topic : summary.topics) {
    yaml += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        topic.topic.name,
        topic.topic.type,
        Quoted(QosOf(topic.topic)),
        topic.messages);
  }
  return yaml + fmt::format(
                    "  compression_format: \"\"\n  compression_mode: \"\"\n"
                    "  relative_file_paths:\n    - {0}\n  files:\n    - path: {0}\n"
                    "      starting_time:\n        nanoseconds_since_epoch: {1}\n"
                    "      duration:\n        nanoseconds: {2}\n      message_count: {3}\n",
                    Quoted(file_name),
                    start,
                    duration,
                    summary.messages);
}

}  // namespace qwsm::io
