// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "service/dds/gateway/topic_feed.hpp"
#include "service/io/bags/writing/bag_file.hpp"

namespace qwsm::pipeline {

/// Keeps what is said on the network as a bag, message for message as it went over the wire.
class BagRecorder {
 public:
  struct Tell {
    std::function<void(const std::string&)> info;
    std::function<void(const std::string&)> warn;
  };

  /// Starts to record.
  /// @param robot namespace to which topics have to belong, unless all robots share them, as /tf;
  ///        empty: all topics. @param bag and participant outlive this. @throws dds::DdsError.
  BagRecorder(const dds::Participant& participant,
              const std::string& robot,
              io::BagFile& bag,
              Tell tell);

  /// Waits until something is said, or for the timeout, and writes it. @throws io::WriteError.
  void Record(std::chrono::nanoseconds timeout);

  std::size_t messages() const { return messages_; }
  /// Of these, scans of lasers and clouds of points.
  std::size_t scans() const { return scans_; }
  std::size_t topics() const { return topics_.size(); }

 private:
  dds::TopicFeed::Listener ListenerFor(const std::string& robot);
  void Take(const dds::PublishedTopic& topic, const dds::RawSample& sample);

  io::BagFile& bag_;
  Tell tell_;
  std::map<std::string, io::TopicToWrite> topics_;
  std::size_t messages_ = 0;
  std::size_t scans_ = 0;
  dds::TopicFeed feed_;
};

}  // namespace qwsm::pipeline
