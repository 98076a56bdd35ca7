// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/cloud_survey.hpp"

#include <algorithm>

#include "service/io/bags/messages/point_cloud_message.hpp"

namespace slam6d::io {
namespace {

using namespace qwsm::io;

/// Sorts the messages of a bag by what they are for.
class CloudSurveyor {
 public:
  CloudSurveyor(CloudContents& contents, LogReport& report, BagFaults& faults)
      : contents_(contents), report_(report), faults_(faults) {}

  void Take(const BagTopic& topic, const BagMessage& message, std::uint32_t file) {
    ++report_.lines;
    if (topic.encoding == Encoding::kOther) return;
    try {
      const std::string_view bytes = PlainMessage(message.bytes, buffer_);
      if (topic.type == kPointCloudMessage) {
        TakeCloud(topic, message, bytes, file);
      } else if (topic.type == kOdometryMessage) {
        TakeOdometry(topic, DecodeOdometry(bytes, topic.encoding));
      } else if (topic.type == kTransformsMessage || topic.type == kOldTransformsMessage) {
        TakeTransforms(topic, bytes);
      }
    } catch (const MessageError& error) {
      faults_.OfMessage(topic.name, report_.lines, error.what());
    }
  }

 private:
  void TakeCloud(const BagTopic& topic,
                 const BagMessage& message,
                 std::string_view bytes,
                 std::uint32_t file) {
    const RosHeader header = DecodeHeader(bytes, topic.encoding);
    CloudTopic& clouds = contents_.clouds[topic.name];
    if (clouds.places.empty()) clouds.frame = FrameName(header.frame);
    clouds.places.push_back({.stamp = header.stamp,
                             .sequence = report_.lines,
                             .address = message.address,
                             .file = file,
                             .topic = static_cast<std::uint32_t>(message.topic)});
  }

  void TakeOdometry(const BagTopic& topic, const OdometryMessage& pose) {
    OdometryTopic3& odometry = contents_.odometry[topic.name];
    odometry.child_frame = FrameName(pose.child_frame);
    odometry.track.Add(pose.header.stamp, PoseOf(pose.T_frame_child));
  }

  void TakeTransforms(const BagTopic& topic, std::string_view bytes) {
    const std::string name_space = NamespaceOf(topic.name);
    TransformTree& tree = contents_.transforms[name_space];
    const bool is_static = topic.name.ends_with("tf_static");
    for (const TransformMessage& transform : DecodeTransforms(bytes, topic.encoding)) {
      if (!tree.Take(transform, is_static, report_.lines)) {
        faults_.OfMessage(topic.name,
                          report_.lines,
                          "a transform is none, has no name, or has another parent than before");
      } else if (!is_static) {
        contents_.tracks[name_space][FrameName(transform.child_frame)].Add(
            transform.header.stamp, PoseOf(transform.T_frame_child));
      }
    }
  }

  CloudContents& contents_;
  LogReport& report_;
  BagFaults& faults_;
  std::string buffer_;
};

void PutInOrder(CloudContents& contents) {
  for (auto& [topic, clouds] : contents.clouds) {
    std::ranges::stable_sort(clouds.places, {}, &MessagePlace::stamp);
  }
  for (auto& [topic, odometry] : contents.odometry) odometry.track.Sort();
  for (auto& [name_space, tracks] : contents.tracks) {
    for (auto& [frame, track] : tracks) track.Sort();
  }
}

}  // namespace

Pose3 PoseOf(const Transform3& transform) {
  const qwsm::Quaternion& q = transform.rotation;
  return {.rotation = RotationFromQuaternion({q.x, q.y, q.z, q.w}),
          .translation_m = {transform.x_m, transform.y_m, transform.z_m}};
}

CloudContents SurveyClouds(const std::filesystem::path& path,
                           LogReport& report,
                           BagFaults& faults) {
  CloudContents contents;
  CloudSurveyor surveyor(contents, report, faults);
  ForEachMessage(path,
                 faults,
                 contents.files,
                 [&](const BagTopic& topic, const BagMessage& message, std::uint32_t file) {
                   surveyor.Take(topic, message, file);
                 });
  PutInOrder(contents);
  return contents;
}

}  // namespace slam6d::io
