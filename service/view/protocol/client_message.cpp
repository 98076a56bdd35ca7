// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/protocol/client_message.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace qwsm::view {
namespace {

using Json = nlohmann::json;

// Names that go back to the client in an answer.
constexpr std::size_t kLongestOperation = 64;
constexpr std::size_t kLongestName = 512;

constexpr char kMessageData = 1;
constexpr std::size_t kMessageHead = 5;

const Json& Get(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end()) {
    throw ProtocolError(fmt::format("'{}' is missing", key));
  }
  return *found;
}

std::uint32_t ToId(const Json& value) {
  if (!value.is_number_unsigned() ||
      value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    throw ProtocolError("an id must be a whole number of 32 bits");
  }
  return value.get<std::uint32_t>();
}

std::string TextOf(const Json& object, const char* key) {
  const Json& value = Get(object, key);
  if (!value.is_string()) throw ProtocolError(fmt::format("'{}' must be a text", key));
  const auto& text = value.get_ref<const std::string&>();
  if (text.size() > kLongestName) throw ProtocolError(fmt::format("'{}' is too long", key));
  return text;
}

const Json& ListOf(const Json& object, const char* key) {
  const Json& value = Get(object, key);
  if (!value.is_array()) throw ProtocolError(fmt::format("'{}' must be a list", key));
  return value;
}

std::vector<std::uint32_t> IdsOf(const Json& object, const char* key) {
  std::vector<std::uint32_t> ids;
  for (const Json& id : ListOf(object, key)) ids.push_back(ToId(id));
  return ids;
}

/// Whether something is there and true.
bool IsSet(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  if (!found->is_boolean()) throw ProtocolError(fmt::format("'{}' must be true or false", key));
  return found->get<bool>();
}

Subscribe ToSubscribe(const Json& message) {
  Subscribe subscribe;
  for (const Json& one : ListOf(message, "subscriptions")) {
    subscribe.subscriptions.push_back({.id = ToId(Get(one, "id")),
                                       .channel = ToId(Get(one, "channelId")),
                                       .wants_news_only = IsSet(one, "newsOnly")});
  }
  return subscribe;
}

Advertise ToAdvertise(const Json& message) {
  Advertise advertise;
  for (const Json& one : ListOf(message, "channels")) {
    advertise.channels.push_back({.id = ToId(Get(one, "id")),
                                  .topic = TextOf(one, "topic"),
                                  .encoding = TextOf(one, "encoding"),
                                  .schema = TextOf(one, "schemaName")});
  }
  return advertise;
}

}  // namespace

ClientMessage ParseClientText(std::string_view text) {
  constexpr bool kNoExceptions = false;
  const Json message = Json::parse(text, nullptr, kNoExceptions);
  if (message.is_discarded()) throw ProtocolError("this is no JSON");
  const std::string operation = TextOf(message, "op");
  if (operation == "subscribe") return ToSubscribe(message);
  if (operation == "unsubscribe") return Unsubscribe{IdsOf(message, "subscriptionIds")};
  if (operation == "advertise") return ToAdvertise(message);
  if (operation == "unadvertise") return Unadvertise{IdsOf(message, "channelIds")};
  return NotOffered{operation.substr(0, kLongestOperation)};
}

ClientData ParseClientData(std::string_view bytes) {
  if (bytes.size() < kMessageHead) throw ProtocolError("a message in bytes is too short");
  if (bytes[0] != kMessageData) throw ProtocolError("only messages of channels come in bytes");
  ClientData data{.channel = 0, .cdr = bytes.substr(kMessageHead)};
  for (std::size_t i = kMessageHead - 1; i > 0; --i) {
    data.channel = (data.channel << 8U) | static_cast<unsigned char>(bytes[i]);
  }
  return data;
}

}  // namespace qwsm::view
