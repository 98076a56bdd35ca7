// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/gateway/topic_gateway.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {
namespace {

// What is not ours could be without bound: who publishes more topics is no team but an attack.
constexpr std::size_t kMostTopics = 2048;
constexpr int kNicenessOfGateway = 5;
// Samples are looked for so often, and wake nobody when they come: the moment a scan arrives belongs
// to whoever matches it.
constexpr std::chrono::milliseconds kLookPeriod{20};

}  // namespace

TopicGateway::TopicGateway(const Participant& participant, const RosGraph& graph, Listener listener)
    : participant_(participant),
      graph_(graph),
      listener_(std::move(listener)),
      wait_set_(participant),
      publications_(participant),
      poses_(participant) {
  wait_set_.Add(publications_.handle());
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

TopicGateway::~TopicGateway() {
  thread_.request_stop();
  wait_set_.Wake();
  thread_.join();
}

void TopicGateway::Want(const std::string& topic) {
  Do([this, topic] {
    if (wanted_.insert(topic).second) Listen(topic);
  });
}

void TopicGateway::PreparePose(const std::string& topic) {
  Do([this, topic] { poses_.Prepare(topic); });
}

void TopicGateway::TellPose(const std::string& topic, const ToldPose& pose) {
  Do([this, topic, pose] { poses_.Tell(topic, pose); });
}

void TopicGateway::Run(const std::stop_token& stop) {
  // Who looks on gives way to who matches; on Linux the niceness is a thread's own.
  setpriority(PRIO_PROCESS, 0, kNicenessOfGateway);
  while (!stop.stop_requested()) {
    wait_set_.Wait(readers_.empty() ? std::chrono::seconds(1) : kLookPeriod);
    DoTasks();
    NoteTopics();
    PassOnSamples();
  }
}

void TopicGateway::Do(std::function<void()> task) {
  const std::lock_guard lock(mutex_);
  tasks_.push_back(std::move(task));
  wait_set_.Wake();
}

void TopicGateway::DoTasks() {
  std::vector<std::function<void()>> tasks;
  {
    const std::lock_guard lock(mutex_);
    tasks.swap(tasks_);
  }
  for (const auto& task : tasks) Try(task);
}

/// Does what fails where the middleware does not want a topic, whose name comes from anybody.
void TopicGateway::Try(const std::function<void()>& task) const {
  try {
    task();
  } catch (const DdsError& error) {
    listener_.warn(error.what());
  }
}

void TopicGateway::NoteTopics() {
  bool has_changed = false;
  publications_.TakeAll([&](const Publication& publication) {
    has_changed |= publication.is_alive ? Note(publication) : Forget(publication.writer);
  });
  if (!has_changed) return;
  std::vector<PublishedTopic> told;
  for (const auto& [name, topic] : topics_) told.push_back(topic.told);
  listener_.take_topics(std::move(told));
}

/// Remembers a writer. @returns whether its topic is new.
bool TopicGateway::Note(const Publication& publication) {
  const std::optional<std::string> name = RosTopicOf(publication.topic);
  const TopicType* const type = FindTopicType(publication.type);
  if (!name || type == nullptr) return false;
  if (topics_.size() >= kMostTopics && !topics_.contains(*name)) return false;
  const PublishedTopic told{
      .name = *name, .type = std::string(type->ros_name), .is_latched = publication.is_latched};
  const auto [topic, is_new] = topics_.try_emplace(*name, Topic{.told = told, .type = type});
  topic->second.writers.insert(publication.writer);
  if (is_new && wanted_.contains(*name)) Try([&] { Listen(*name); });
  return is_new;
}

/// Forgets a writer. @returns whether its topic is gone with it.
bool TopicGateway::Forget(const Guid& writer) {
  const auto topic = std::ranges::find_if(
      topics_, [&](const auto& named) { return named.second.writers.contains(writer); });
  if (topic == topics_.end()) return false;
  topic->second.writers.erase(writer);
  if (!topic->second.writers.empty()) return false;
  readers_.erase(topic->first);
  topics_.erase(topic);
  return true;
}

void TopicGateway::Listen(const std::string& topic) {
  const auto found = topics_.find(topic);
  if (found == topics_.end() || readers_.contains(topic)) return;
  const auto& [told, type, writers] = found->second;
  readers_.try_emplace(
      topic, participant_, *type->descriptor, topic, type->ReaderProfile(told.is_latched));
  graph_.Announce();
}

void TopicGateway::PassOnSamples() {
  std::vector<TopicSamples> passed;
  for (const auto& [topic, reader] : readers_) {
    std::vector<RawSample> samples;
    reader.TakeAll([&samples](RawSample sample) { samples.push_back(std::move(sample)); });
    if (!samples.empty()) passed.push_back({.topic = topic, .samples = std::move(samples)});
  }
  if (!passed.empty()) listener_.take_samples(std::move(passed));
}

}  // namespace qwsm::dds
