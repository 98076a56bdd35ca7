// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/writer.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <cctype>

namespace qwsm::dds {

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

UntypedWriter::UntypedWriter(const Participant& participant,
                             const dds_topic_descriptor_t& descriptor,
                             const std::string& topic,
                             Profile profile) {
  const Qos qos = QosOf(profile);
  const std::string name = DdsTopicName(topic);
  topic_ = Entity(
      dds_create_topic(participant.handle(), &descriptor, name.c_str(), nullptr, nullptr), topic);
  writer_ = Entity(dds_create_writer(participant.handle(), topic_.handle(), qos.get(), nullptr),
                   topic + ": cannot be written");
}

std::size_t UntypedWriter::reader_count() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(handle(), &status);
  return status.current_count;
}

bool UntypedWriter::WriteSample(const void* sample) const {
  return dds_write(handle(), sample) == DDS_RETCODE_OK;
}

}  // namespace qwsm::dds
