// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What clients say, in version 1 of the Foxglove WebSocket protocol.
namespace qwsm::view {

/// Tells that a message is none of the protocol; the text says what is wrong, for the client.
class ProtocolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Subscription {
  std::uint32_t id = 0;  ///< Chosen by the client.
  std::uint32_t channel = 0;
  /// Of messages that say what the last one said, none: our addition to the protocol ("newsOnly").
  bool wants_news_only = false;
};
struct Subscribe {
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};

/// A channel on which the client is going to publish.
struct ClientChannel {
  std::uint32_t id = 0;  ///< Chosen by the client.
  std::string topic;
  std::string encoding;
  std::string schema;
};
struct Advertise {
  std::vector<ClientChannel> channels;
};
struct Unadvertise {
  std::vector<std::uint32_t> channels;
};
/// Something of the protocol that was not offered to the client.
struct NotOffered {
  std::string operation;
};

using ClientMessage = std::variant<Subscribe, Unsubscribe, Advertise, Unadvertise, NotOffered>;

/// Unpacks a message in text. @throws ProtocolError.
ClientMessage ParseClientText(std::string_view text);

/// A message that the client publishes.
struct ClientData {
  std::uint32_t channel = 0;
  std::string_view cdr;
};

/// Unpacks a message in bytes, into which the result points. @throws ProtocolError.
ClientData ParseClientData(std::string_view bytes);

}  // namespace qwsm::view
