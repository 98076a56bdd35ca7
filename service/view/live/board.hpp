// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "service/dds/gateway/topic_gateway.hpp"
#include "service/view/protocol/server_message.hpp"
#include "service/view/streams/map_tiles.hpp"
#include "service/view/streams/news.hpp"
#include "service/view/streams/recent_samples.hpp"

namespace qwsm::view {

/// What goes first where a line is too slow for all: where robots are, then what they see.
enum class Urgency { kPose, kScan, kMap };
inline constexpr Urgency kUrgencies[] = {Urgency::kPose, Urgency::kScan, Urgency::kMap};

/// Something that clients can subscribe to.
struct Channel {
  ChannelInfo info;
  Urgency urgency = Urgency::kPose;
  std::string source;  ///< The topic from which its samples are made.
  std::shared_ptr<const SampleStream> stream;
  /// Of the same samples those that tell something new; null where there is no such choice.
  std::shared_ptr<const SampleStream> news{};
};

/// All channels with what they have to send: the topics of the network, and of each drawn map its
/// tiles. Used by one thread.
class Board {
 public:
  using Channels = std::map<std::uint32_t, Channel>;
  using Warn = std::function<void(const std::string&)>;

  /// Begins without channels. @param warn is told of maps that make no sense.
  explicit Board(Warn warn) : warn_(std::move(warn)) {}

  /// Takes all topics that there are now.
  void TakeTopics(const std::vector<dds::PublishedTopic>& topics);
  void TakeSamples(const dds::TopicSamples& taken, Clock::time_point now);

  const Channels& channels() const { return channels_; }
  /// Grows when channels come or go.
  std::uint64_t version() const { return version_; }
  /// Whether topics of a type are to be read though nobody has asked for them: where robots were
  /// last is told to whoever comes when they are gone.
  static bool IsKeptUnasked(std::string_view type);
  /// Whether the topic is one on which a robot can be told where it is.
  bool IsPoseTopic(std::string_view topic) const;

 private:
  struct Source {
    dds::PublishedTopic topic;
    std::vector<std::uint32_t> channels;
    std::shared_ptr<RecentSamples> samples;
    std::unique_ptr<NewsFilter> filter;   // Null where all samples are news.
    std::shared_ptr<RecentSamples> news;  // Null where there is no filter.
    std::shared_ptr<MapTiles> tiles;      // Null where the topic is no map.
  };

  void Add(const dds::PublishedTopic& topic);
  void Remove(const Source& source);
  void Offer(Source& source, Channel channel);
  void TakeMap(const Source& source, const Sample& sample);

  Warn warn_;
  Channels channels_;
  std::map<std::string, Source, std::less<>> sources_;
  std::uint32_t last_id_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace qwsm::view
