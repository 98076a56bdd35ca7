// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// A topic to be written, in CDR.
struct TopicToWrite {
  std::string name;
  std::string type;         ///< As ROS 2 writes it: "sensor_msgs/msg/LaserScan".
  bool is_latched = false;  ///< Late listeners get the last message (transient local).
};

/// What is in a bag, as its metadata say.
struct BagSummary {
  struct Topic {
    TopicToWrite topic;
    std::uint64_t messages = 0;
  };

  std::vector<Topic> topics;
  std::uint64_t messages = 0;
  Timestamp first{};
  Timestamp last{};

  /// Counts a message.
  void Count(std::size_t topic, Timestamp stamp);
};

/// Writes messages into a bag of one format.
class BagWriter {
 public:
  BagWriter() = default;
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;
  virtual ~BagWriter() = default;

  /// What rosbag2 calls the format: "mcap" or "sqlite3".
  virtual std::string_view storage() const = 0;
  /// Adds a topic. @return its number, for Write().
  virtual std::size_t AddTopic(const TopicToWrite& topic) = 0;
  virtual void Write(std::size_t topic, Timestamp stamp, std::string_view cdr) = 0;
  /// Writes what ends a bag, such as its index.
  /// @param file_name of the bag's one file, for its own metadata.
  virtual void Finish(const std::string& file_name) = 0;

  const BagSummary& summary() const { return summary_; }

 protected:
  BagSummary summary_;
};

/// The quality of service of a topic, as rosbag2 keeps it: YAML.
std::string QosOf(const TopicToWrite& topic);

/// The metadata.yaml of a bag of one file; version 5, which all of Humble and later read.
std::string MetadataYaml(const BagSummary& summary,
                         std::string_view storage,
                         const std::string& file_name);

}  // namespace qwsm::io
