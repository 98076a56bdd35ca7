// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/live/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "service/dds/wire/robot_names.hpp"
#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/bags/writing/message_definitions.hpp"

namespace qwsm::view {
namespace {

constexpr std::string_view kGridType = "nav_msgs/msg/OccupancyGrid";
constexpr std::string_view kTileType = "qwsm_msgs/msg/MapTile";
constexpr std::string_view kReportType = "qwsm_msgs/msg/MatchReport";
constexpr std::string_view kRegistrationType = "qwsm_msgs/msg/RegistrationReport";
constexpr std::string_view kTilesSuffix = "_tiles";

Urgency UrgencyOf(std::string_view type) {
  if (type == kGridType || type == "qwsm_msgs/msg/RelevantScan") return Urgency::kMap;
  if (type == "sensor_msgs/msg/LaserScan" || type == "sensor_msgs/msg/PointCloud2") {
    return Urgency::kScan;
  }
  return Urgency::kPose;
}

/// Of what is kept for late comers, as much as its writers keep (docs/dds.md). Of a robot that
/// scans in space each answer counts: it says which loops were closed.
RecencyOptions RecencyOf(const dds::PublishedTopic& topic) {
  if (topic.type == kRegistrationType) {
    return {.depth = 4096, .for_late_comers = ForLateComers::kAll};
  }
  if (!topic.is_latched) return {};
  RecencyOptions options{.depth = 1, .for_late_comers = ForLateComers::kAll};
  if (topic.type == "qwsm_msgs/msg/RelevantScan") options.depth = 262'144;
  if (topic.type == "qwsm_msgs/msg/Mark") options.depth = 4096;  // Of several services.
  if (topic.type == "tf2_msgs/msg/TFMessage") options.depth = 100;
  return options;
}

ChannelInfo InfoOf(std::string topic, std::string_view type) {
  return {.id = 0,
          .topic = std::move(topic),
          .schema_name = std::string(type),
          .schema = io::MessageDefinition(type)};
}

}  // namespace

void Board::TakeTopics(const std::vector<dds::PublishedTopic>& topics) {
  std::set<std::string_view> names;
  for (const dds::PublishedTopic& topic : topics) names.insert(topic.name);
  std::erase_if(sources_, [&](const auto& named) {
    if (names.contains(named.first)) return false;
    Remove(named.second);
    return true;
  });
  for (const dds::PublishedTopic& topic : topics) {
    if (!sources_.contains(topic.name)) Add(topic);
  }
  ++version_;
}

void Board::Add(const dds::PublishedTopic& topic) {
  Source source{.topic = topic,
                .channels = {},
                .samples = std::make_shared<RecentSamples>(RecencyOf(topic)),
                .filter = NewsFilterOf(topic.type),
                .news = nullptr,
                .tiles = nullptr};
  if (source.filter) {
    source.news =
        std::make_shared<RecentSamples>(RecencyOptions{.for_late_comers = ForLateComers::kLast});
  }
  Offer(source,
        {.info = InfoOf(topic.name, topic.type),
         .urgency = UrgencyOf(topic.type),
         .source = topic.name,
         .stream = source.samples,
         .news = source.news});
  if (topic.type == kGridType) {
    source.tiles = std::make_shared<MapTiles>();
    Offer(source,
          {.info = InfoOf(topic.name + std::string(kTilesSuffix), kTileType),
           .urgency = Urgency::kMap,
           .source = topic.name,
           .stream = source.tiles});
  }
  sources_.emplace(topic.name, std::move(source));
}

void Board::Offer(Source& source, Channel channel) {
  channel.info.id = ++last_id_;
  source.channels.push_back(channel.info.id);
  channels_.emplace(channel.info.id, std::move(channel));
}

void Board::Remove(const Source& source) {
  for (const std::uint32_t id : source.channels) channels_.erase(id);
}

void Board::TakeSamples(const dds::TopicSamples& taken, Clock::time_point now) {
  const auto source = sources_.find(taken.topic);
  if (source == sources_.end()) return;
  for (const dds::RawSample& raw : taken.samples) {
    const Sample sample{
        .owner = raw.owner, .bytes = raw.cdr, .stamp_ns = raw.stamp_ns, .arrived = now};
    source->second.samples->Add(sample);
    if (source->second.filter && source->second.filter->IsNews(sample)) {
      source->second.news->Add(sample);
    }
    if (source->second.tiles) TakeMap(source->second, sample);
  }
}

void Board::TakeMap(const Source& source, const Sample& sample) {
  try {
    source.tiles->Take(DecodeGrid(sample.bytes), sample.stamp_ns, sample.arrived);
  } catch (const io::MessageError& error) {
    warn_(fmt::format("{}: the map is not shown: {}", source.topic.name, error.what()));
  }
}

bool Board::IsKeptUnasked(std::string_view type) {
  return type == kReportType || type == kRegistrationType;
}

bool Board::IsPoseTopic(std::string_view topic) const {
  const auto robot = dds::RobotNames::RobotOf(fmt::format("rt{}", topic), dds::kInitialPoseTopic);
  if (!robot) return false;
  const dds::RobotNames names(*robot);
  return std::ranges::any_of(
      std::array{dds::kScanTopic, dds::kCloudTopic, dds::kReportTopic, dds::kRegistrationTopic},
      [&](std::string_view part) { return sources_.contains(names.Topic(part)); });
}

}  // namespace qwsm::view
