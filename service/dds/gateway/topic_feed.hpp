// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "service/dds/entities/publications.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/dds/gateway/published_topic.hpp"
#include "service/dds/gateway/raw_reader.hpp"
#include "service/dds/gateway/topic_type.hpp"

namespace qwsm::dds {

/// Hears all that is published in the domain in types that are known, as it went over the wire, and
/// hands it over in the thread of its caller: for recordings, from which nothing is to be missing.
class TopicFeed {
 public:
  struct Listener {
    /// Whether a topic is wanted, by its name as ROS has it; asked once.
    std::function<bool(const std::string& topic)> wants;
    /// Takes a sample of a topic.
    std::function<void(const PublishedTopic& topic, const RawSample& sample)> take;
    /// Is told once of each topic that is wanted and cannot be heard, and why.
    std::function<void(const PublishedTopic& topic, const std::string& why)> pass_over;
  };

  /// Starts to look around. @param participant outlives this. @throws DdsError.
  TopicFeed(const Participant& participant, Listener listener);

  /// Waits until something has arrived, or for the timeout, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout);

 private:
  /// What is asked of the writers of a topic: no more than the weakest of them offers.
  struct Terms {
    bool is_reliable = false;
    bool is_latched = false;

    bool operator==(const Terms&) const = default;
  };
  struct Heard {
    PublishedTopic told;
    const TopicType* type;
    Terms terms;
    RawReader reader;
  };

  static Profile ProfileOf(const Terms& terms);
  void Note(const Publication& publication);
  void Listen(const PublishedTopic& told, const TopicType& type, const Terms& terms);
  void Weaken(const Heard& heard, const Terms& terms);
  void PassOver(const PublishedTopic& topic, const std::string& why);
  void TakeFrom(const Heard& heard) const;

  const Participant& participant_;
  Listener listener_;
  WaitSet wait_set_;
  Publications publications_;
  std::set<std::string> passed_over_;  // Unwanted topics, and those that cannot be heard.
  std::map<std::string, Heard> heard_;
};

}  // namespace qwsm::dds
