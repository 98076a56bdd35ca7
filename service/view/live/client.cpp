// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/live/client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "service/dds/wire/robot_names.hpp"
#include "service/io/bags/messages/message_reader.hpp"
#include "service/view/protocol/told_mark.hpp"
#include "service/view/protocol/told_pose.hpp"

namespace qwsm::view {
namespace {

// More than the page, or Foxglove, ever asks for: whoever asks for more is told so.
constexpr std::size_t kMostSubscriptions = 4096;
constexpr std::size_t kMostPublications = 256;
constexpr std::size_t kMostTexts = 16;
constexpr std::chrono::milliseconds kTimePeriod{100};

constexpr std::string_view kMarkSchema = "qwsm_msgs/msg/Mark";
constexpr std::string_view kPoseSchema = "geometry_msgs/msg/PoseWithCovarianceStamped";
constexpr std::string_view kOldPoseSchema = "geometry_msgs/PoseWithCovarianceStamped";

std::uint64_t NowNs() {
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::system_clock::now().time_since_epoch())
                                        .count());
}

bool IsMarks(const ClientChannel& channel) {
  return channel.encoding == "cdr" && channel.schema == kMarkSchema &&
         channel.topic == dds::kMarksTopic;
}

}  // namespace

Client::Client(const Board& board, const Uplink& uplink, std::string greeting)
    : board_(board), uplink_(uplink), texts_{std::move(greeting)} {}

void Client::TakeText(std::string_view text) {
  try {
    std::visit([this](const auto& message) { Take(message); }, ParseClientText(text));
  } catch (const ProtocolError& error) {
    Tell(StatusLevel::kError, error.what());
  }
}

void Client::TakeBytes(std::string_view bytes) {
  try {
    Publish(ParseClientData(bytes));
  } catch (const ProtocolError& error) {
    Tell(StatusLevel::kError, error.what());
  } catch (const io::MessageError& error) {
    Tell(StatusLevel::kError, fmt::format("the message cannot be read: {}", error.what()));
  }
}

void Client::Publish(const ClientData& data) {
  const auto channel = publications_.find(data.channel);
  if (channel == publications_.end()) {
    throw ProtocolError(fmt::format("channel {} was not advertised", data.channel));
  }
  const std::string& topic = channel->second.topic;
  if (IsMarks(channel->second)) return uplink_.tell_mark(DecodeToldMark(data.cdr));
  if (IsPose(channel->second)) return uplink_.tell_pose(topic, DecodeToldPose(data.cdr));
  throw ProtocolError(
      fmt::format("'{}' is not taken; only, in cdr, {} as {}, and NAME/initialpose of a robot that "
                  "is there as {}",
                  topic,
                  dds::kMarksTopic,
                  kMarkSchema,
                  kPoseSchema));
}

bool Client::IsPose(const ClientChannel& channel) const {
  return channel.encoding == "cdr" &&
         (channel.schema == kPoseSchema || channel.schema == kOldPoseSchema) &&
         board_.IsPoseTopic(channel.topic);
}

void Client::Take(const Subscribe& subscribe) {
  for (const Subscription& subscription : subscribe.subscriptions) Add(subscription);
}

void Client::Add(const Subscription& subscription) {
  const auto channel = board_.channels().find(subscription.channel);
  if (channel == board_.channels().end()) {
    // It may have gone while the client asked for it: no error.
    return Tell(StatusLevel::kWarning, fmt::format("there is no channel {}", subscription.channel));
  }
  if (subscriptions_.size() >= kMostSubscriptions) {
    return Tell(StatusLevel::kError, "there are too many subscriptions");
  }
  if (!subscriptions_.insert(subscription.id).second) {
    return Tell(StatusLevel::kError,
                fmt::format("subscription {} is there already", subscription.id));
  }
  const bool is_choosy = subscription.wants_news_only && channel->second.news != nullptr;
  const auto& stream = is_choosy ? channel->second.news : channel->second.stream;
  Round& round = rounds_[static_cast<std::size_t>(channel->second.urgency)];
  round.readings.push_back({.subscription = subscription.id,
                            .channel = subscription.channel,
                            .stream = stream,
                            .cursor = stream->Begin()});
  uplink_.want(channel->second.source);
}

void Client::Take(const Unsubscribe& unsubscribe) {
  for (const std::uint32_t id : unsubscribe.subscriptions) subscriptions_.erase(id);
  DropReadings(
      [this](const Reading& reading) { return !subscriptions_.contains(reading.subscription); });
}

void Client::DropReadings(const std::function<bool(const Reading&)>& is_void) {
  for (Round& round : rounds_) std::erase_if(round.readings, is_void);
}

void Client::Take(const Advertise& advertise) {
  for (const ClientChannel& channel : advertise.channels) Add(channel);
}

// Foxglove advertises goals and points as soon as it connects: who publishes nothing does nothing
// wrong. Whether a channel is taken shows when something comes.
void Client::Add(const ClientChannel& channel) {
  if (publications_.size() >= kMostPublications) {
    return Tell(StatusLevel::kError, "there are too many channels of this client");
  }
  publications_.insert_or_assign(channel.id, channel);
  if (IsPose(channel)) uplink_.prepare_pose(channel.topic);
}

void Client::Take(const Unadvertise& unadvertise) {
  for (const std::uint32_t channel : unadvertise.channels) publications_.erase(channel);
}

void Client::Take(const NotOffered& request) {
  Tell(StatusLevel::kWarning, fmt::format("'{}' is not offered", request.operation));
}

/// A client that causes more than it reads misses the rest.
void Client::Tell(StatusLevel level, const std::string& text) {
  if (texts_.size() < kMostTexts) texts_.push_back(StatusText(level, text));
}

std::optional<Outgoing> Client::Next(Clock::time_point now) {
  if (texts_.empty()) NoteChannels();
  if (!texts_.empty()) {
    Outgoing outgoing{.is_text = true, .head = std::move(texts_.front())};
    texts_.pop_front();
    return outgoing;
  }
  if (now >= next_time_) {
    next_time_ = now + kTimePeriod;
    return Outgoing{.is_text = false, .head = TimeBytes(NowNs())};
  }
  for (Round& round : rounds_) {
    if (auto outgoing = Next(round, now)) return outgoing;
  }
  return std::nullopt;
}

/// Tells what has come and gone among the channels since the last time.
void Client::NoteChannels() {
  if (seen_version_ == board_.version()) return;
  seen_version_ = board_.version();
  const auto& channels = board_.channels();
  std::vector<std::uint32_t> gone;
  for (const std::uint32_t id : advertised_) {
    if (!channels.contains(id)) gone.push_back(id);
  }
  for (const std::uint32_t id : gone) advertised_.erase(id);
  DropReadings([&](const Reading& reading) {
    if (channels.contains(reading.channel)) return false;
    subscriptions_.erase(reading.subscription);
    return true;
  });
  std::vector<const ChannelInfo*> come;
  for (const auto& [id, channel] : channels) {
    if (advertised_.insert(id).second) come.push_back(&channel.info);
  }
  if (!gone.empty()) texts_.push_back(UnadvertiseText(gone));
  if (!come.empty()) texts_.push_back(AdvertiseText(come));
}

std::optional<Outgoing> Client::Next(Round& round, Clock::time_point now) {
  const std::size_t count = round.readings.size();
  for (std::size_t i = 0; i < count; ++i) {
    Reading& reading = round.readings[(round.turn + i) % count];
    const std::optional<Sample> sample = reading.stream->Next(reading.cursor, now);
    if (!sample) continue;
    round.turn = (round.turn + i + 1) % count;
    return Outgoing{.is_text = false,
                    .head = MessageHead(reading.subscription, sample->stamp_ns),
                    .sample = *sample};
  }
  return std::nullopt;
}

}  // namespace qwsm::view
