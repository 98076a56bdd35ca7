// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/bag_recorder.hpp"

#include <fmt/format.h>

#include <utility>

#include "service/dds/wire/robot_names.hpp"

namespace qwsm::pipeline {
namespace {

bool IsScan(const std::string& type) {
  return type == "sensor_msgs/msg/LaserScan" || type == "sensor_msgs/msg/PointCloud2";
}

}  // namespace

BagRecorder::BagRecorder(const dds::Participant& participant,
                         const std::string& robot,
                         io::BagFile& bag,
                         Tell tell)
    : bag_(bag), tell_(std::move(tell)), feed_(participant, ListenerFor(robot)) {}

dds::TopicFeed::Listener BagRecorder::ListenerFor(const std::string& robot) {
  const std::string within = dds::RobotNames(robot).Topic("");
  return {.wants =
              [within](const std::string& topic) {
                return topic.starts_with(within) || topic == dds::kTransformsTopic ||
                       topic == dds::kStaticTransformsTopic;
              },
          .take = [this](const dds::PublishedTopic& topic,
                         const dds::RawSample& sample) { Take(topic, sample); },
          .pass_over =
              [this](const dds::PublishedTopic& topic, const std::string& why) {
                tell_.warn(fmt::format("{} ({}) is not recorded: {}", topic.name, topic.type, why));
              }};
}

void BagRecorder::Record(std::chrono::nanoseconds timeout) {
  feed_.Deliver(timeout);
  bag_.ThrowIfFailed();
}

void BagRecorder::Take(const dds::PublishedTopic& topic, const dds::RawSample& sample) {
  const auto [known, is_new] = topics_.try_emplace(
      topic.name,
      io::TopicToWrite{.name = topic.name, .type = topic.type, .is_latched = topic.is_latched});
  if (is_new) tell_.info(fmt::format("recording {} ({})", topic.name, topic.type));
  bag_.Write(known->second, Timestamp(static_cast<std::int64_t>(sample.stamp_ns)), sample.cdr);
  ++messages_;
  if (IsScan(topic.type)) ++scans_;
}

}  // namespace qwsm::pipeline
