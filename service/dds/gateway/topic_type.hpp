// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "service/dds/entities/profile.hpp"
#include "service/dds/entities/wire_types.hpp"

namespace qwsm::dds {

/// A type of message that can be passed on.
struct TopicType {
  std::string_view ros_name;  ///< Such as `sensor_msgs/msg/LaserScan`.
  const dds_topic_descriptor_t* descriptor = nullptr;

  /// How a topic of this type is read whose writers keep what they wrote, or do not.
  Profile ReaderProfile(bool is_latched) const;
};

/// The type by its name in DDS; null for one that we do not have.
const TopicType* FindTopicType(std::string_view dds_name);

}  // namespace qwsm::dds
