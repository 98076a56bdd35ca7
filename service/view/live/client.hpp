// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "service/team/marks/mark.hpp"
#include "service/view/live/board.hpp"
#include "service/view/protocol/client_message.hpp"

namespace qwsm::view {

/// What clients may cause outside of the view.
struct Uplink {
  /// Is called for the topic that a client subscribes to.
  std::function<void(const std::string& topic)> want;
  std::function<void(const std::string& topic)> prepare_pose;
  std::function<void(const std::string& topic, const dds::ToldPose&)> tell_pose;
  /// @throws ProtocolError where the mark cannot be taken.
  std::function<void(const team::Mark&)> tell_mark;
};

/// A message to a client.
struct Outgoing {
  bool is_text = false;
  std::string head;
  Sample sample{};  ///< What follows the head; may be nothing.
};

/// One who looks on, as far as it is no socket: what it asked for, and what it gets next.
///
/// It owns no queue of samples: it is asked for the next message whenever the last one is gone.
class Client {
 public:
  /// Greets the client. @param board and uplink outlive this. @param greeting is sent first.
  Client(const Board& board, const Uplink& uplink, std::string greeting);

  /// Takes what the client says. What makes no sense is answered with a status.
  void TakeText(std::string_view text);
  void TakeBytes(std::string_view bytes);

  /// What is to be sent now; nothing where there is nothing.
  std::optional<Outgoing> Next(Clock::time_point now);

 private:
  struct Reading {
    std::uint32_t subscription = 0;
    std::uint32_t channel = 0;
    std::shared_ptr<const SampleStream> stream;
    Cursor cursor = 0;
  };
  /// Subscriptions of one urgency, of which each has its turn.
  struct Round {
    std::vector<Reading> readings;
    std::size_t turn = 0;
  };

  void Take(const Subscribe& subscribe);
  void Take(const Unsubscribe& unsubscribe);
  void Take(const Advertise& advertise);
  void Take(const Unadvertise& unadvertise);
  void Take(const NotOffered& request);
  void Add(const Subscription& subscription);
  void Add(const ClientChannel& channel);
  void Publish(const ClientData& data);
  bool IsPose(const ClientChannel& channel) const;
  void Tell(StatusLevel level, const std::string& text);
  void NoteChannels();
  void DropReadings(const std::function<bool(const Reading&)>& is_void);
  static std::optional<Outgoing> Next(Round& round, Clock::time_point now);

  const Board& board_;
  const Uplink& uplink_;
  std::deque<std::string> texts_;
  std::optional<std::uint64_t> seen_version_;
  std::set<std::uint32_t> advertised_;
  std::set<std::uint32_t> subscriptions_;
  std::array<Round, std::size(kUrgencies)> rounds_;
  std::map<std::uint32_t, ClientChannel> publications_;  // The client's own, by their ids.
  Clock::time_point next_time_{};
};

}  // namespace qwsm::view
