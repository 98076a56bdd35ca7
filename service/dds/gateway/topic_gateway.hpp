// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "service/dds/entities/publications.hpp"
#include "service/dds/entities/wait_set.hpp"
#include "service/dds/gateway/pose_teller.hpp"
#include "service/dds/gateway/published_topic.hpp"
#include "service/dds/gateway/raw_reader.hpp"
#include "service/dds/gateway/topic_type.hpp"
#include "service/dds/service/ros_graph.hpp"

namespace qwsm::dds {

/// Samples of one topic, in order.
struct TopicSamples {
  std::string topic;
  std::vector<RawSample> samples;
};

/// Finds all topics in the domain whose types are known, and reads those that are wanted, in a
/// thread of its own.
class TopicGateway {
 public:
  /// Is called in the gateway's thread.
  struct Listener {
    std::function<void(std::vector<PublishedTopic>)> take_topics;  ///< All, after each change.
    std::function<void(std::vector<TopicSamples>)> take_samples;
    std::function<void(const std::string&)> warn;  ///< Told why a topic cannot be used.
  };

  /// Starts to look around. @param participant and graph outlive this. @throws DdsError.
  TopicGateway(const Participant& participant, const RosGraph& graph, Listener listener);
  TopicGateway(const TopicGateway&) = delete;
  TopicGateway& operator=(const TopicGateway&) = delete;
  ~TopicGateway();

  /// Reads this topic from now on, for as long as somebody publishes it. Any thread may call.
  void Want(const std::string& topic);
  /// Makes the topic by which a robot will be told where it is. Any thread may call.
  void PreparePose(const std::string& topic);
  void TellPose(const std::string& topic, const ToldPose& pose);

 private:
  struct Topic {
    PublishedTopic told;
    const TopicType* type = nullptr;
    std::set<Guid> writers{};
  };

  void Run(const std::stop_token& stop);
  void Do(std::function<void()> task);
  void DoTasks();
  void Try(const std::function<void()>& task) const;
  void NoteTopics();
  bool Note(const Publication& publication);
  bool Forget(const Guid& writer);
  void Listen(const std::string& topic);
  void PassOnSamples();

  const Participant& participant_;
  const RosGraph& graph_;
  Listener listener_;
  WaitSet wait_set_;
  Publications publications_;
  PoseTeller poses_;
  std::map<std::string, Topic> topics_;
  std::set<std::string> wanted_;
  std::map<std::string, RawReader> readers_;
  std::mutex mutex_;
  std::vector<std::function<void()>> tasks_;  // Guarded by mutex_.
  std::jthread thread_;                       // Last: it uses all others.
};

}  // namespace qwsm::dds
