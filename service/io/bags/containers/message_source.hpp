// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// Tells that a bag cannot be opened or is none; the text names no file.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How the messages of a topic are written.
enum class Encoding { kCdr, kRos1, kOther };

/// A connection of a bag: several may have one topic, of as many publishers.
struct BagTopic {
  std::string name;
  std::string type;  ///< As ROS 1 writes it, whoever wrote it: "sensor_msgs/LaserScan".
  Encoding encoding = Encoding::kOther;
};

/// The type as ROS 1 writes it, of a name such as "sensor_msgs/msg/LaserScan".
std::string PlainTypeName(std::string_view type);

/// Where a message stands in its file; what the numbers mean is its source's own business.
struct MessageAddress {
  std::uint64_t container = 0;
  std::uint64_t at = 0;
};

/// A message as it stands in the file.
struct BagMessage {
  std::size_t topic = 0;  ///< Index among the source's topics.
  MessageAddress address;
  std::string_view bytes;  ///< Valid until the source is asked for another message.
};

/// The messages of one file, whatever its format: first all of them as they stand there, then any
/// of them again.
///
/// Damage ends nothing that can be gone around: it is told, and what is good before and behind it
/// is given.
class MessageSource {
 public:
  /// Takes what is wrong with the file, and where: a byte, or a row of a database.
  using TellDamage = std::function<void(std::uint64_t where, const std::string& what)>;

  MessageSource() = default;
  MessageSource(const MessageSource&) = delete;
  MessageSource& operator=(const MessageSource&) = delete;
  virtual ~MessageSource() = default;

  /// "ROS 1 bag", "rosbag2 (mcap)" or "rosbag2 (sqlite3)".
  virtual std::string_view format() const = 0;
  /// All connections met so far.
  virtual const std::vector<BagTopic>& topics() const = 0;
  /// The next message, in the order of the file; nothing at the end.
  virtual std::optional<BagMessage> Next() = 0;
  /// A message that Next() gave: the same bytes, valid until the next call.
  virtual std::string_view Read(const MessageAddress& address) = 0;
};

}  // namespace qwsm::io
