// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <array>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>
#include <vector>

/// ROS 2 messages for Fast DDS, the library under rmw_fastrtps, written down independently of idl/.
namespace qwsm::test::fast {

struct Header {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  std::string frame_id;

  template <class Archive>
  void Visit(Archive&& archive) {
    archive(sec), archive(nanosec), archive(frame_id);
  }
};

struct LaserScan {
  static constexpr const char* kType = "sensor_msgs::msg::dds_::LaserScan_";
  Header header;
  float angle_min = 0, angle_max = 0, angle_increment = 0;
  float time_increment = 0, scan_time = 0, range_min = 0, range_max = 0;
  std::vector<float> ranges;
  std::vector<float> intensities;

  template <class Archive>
  void Visit(Archive&& archive) {
    header.Visit(archive);
    archive(angle_min), archive(angle_max), archive(angle_increment);
    archive(time_increment), archive(scan_time), archive(range_min), archive(range_max);
    archive(ranges), archive(intensities);
  }
};

struct PoseWithCovarianceStamped {
  static constexpr const char* kType = "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_";
  Header header;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 36> covariance{};

  template <class Archive>
  void Visit(Archive&& archive) {
    header.Visit(archive);
    archive(position), archive(orientation), archive(covariance);
  }
};

struct Odometry {
  static constexpr const char* kType = "nav_msgs::msg::dds_::Odometry_";
  Header header;
  std::string child_frame_id;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 36> pose_covariance{};
  std::array<double, 6> twist{};
  std::array<double, 36> twist_covariance{};

  template <class Archive>
  void Visit(Archive&& archive) {
    header.Visit(archive);
    archive(child_frame_id), archive(position), archive(orientation), archive(pose_covariance);
    archive(twist), archive(twist_covariance);
  }
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  std::array<double, 3> translation{};
  std::array<double, 4> rotation{};

  template <class Archive>
  void Visit(Archive&& archive) {
    header.Visit(archive);
    archive(child_frame_id), archive(translation), archive(rotation);
  }
};

struct TFMessage {
  static constexpr const char* kType = "tf2_msgs::msg::dds_::TFMessage_";
  std::vector<TransformStamped> transforms;

  template <class Archive>
  void Visit(Archive&& archive) {
    auto count = static_cast<std::uint32_t>(transforms.size());
    archive(count);
    transforms.resize(count);
    for (TransformStamped& transform : transforms) transform.Visit(archive);
  }
};

struct OccupancyGrid {
  static constexpr const char* kType = "nav_msgs::msg::dds_::OccupancyGrid_";
  Header header;
  std::int32_t load_sec = 0;
  std::uint32_t load_nanosec = 0;
  float resolution = 0;
  std::uint32_t width = 0, height = 0;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::vector<std::int8_t> data;

  template <class Archive>
  void Visit(Archive&& archive) {
    header.Visit(archive);
    archive(load_sec), archive(load_nanosec), archive(resolution), archive(width), archive(height);
    archive(position), archive(orientation), archive(data);
  }
};

/// Type support for one of these messages: CDR, little endian, with its four bytes in front.
template <class Message>
class Type final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

  Type() {
    setName(Message::kType);
    m_typeSize = kMaxBytes;
    m_isGetKeyDefined = false;
  }

  bool serialize(void* data, Payload* payload) override {
    Buffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    static_cast<Message*>(data)->Visit([&cdr](auto& member) { cdr << member; });
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    Buffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    static_cast<Message*>(data)->Visit([&cdr](auto& member) { cdr >> member; });
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return kMaxBytes; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  using Buffer = eprosima::fastcdr::FastBuffer;
  using Cdr = eprosima::fastcdr::Cdr;
  static constexpr std::uint32_t kMaxBytes = 64U << 10;  // To begin with; readers grow.
};

}  // namespace qwsm::test::fast
