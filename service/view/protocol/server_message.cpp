// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/protocol/server_message.hpp"

#include <nlohmann/json.hpp>

namespace qwsm::view {
namespace {

using AnswerJson = nlohmann::json;

constexpr char kDataOperation = 1;
constexpr char kTimeOperation = 2;

template <class Number>
void AppendLittleEndian(std::string& bytes, Number value) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    bytes += static_cast<char>((value >> (8U * i)) & 0xFFU);
  }
}

/// Names come from anybody on the network: what is no UTF-8 is replaced.
std::string DumpJson(const AnswerJson& message) {
  return message.dump(-1, ' ', false, AnswerJson::error_handler_t::replace);
}

}  // namespace

std::string ServerInfoText(const std::string& name, const std::string& session) {
  return DumpJson({{"op", "serverInfo"},
                   {"name", name},
                   {"capabilities", {"clientPublish", "time"}},
                   {"supportedEncodings", {"cdr"}},
                   {"metadata", AnswerJson::object()},
                   {"sessionId", session}});
}

std::string AdvertiseText(std::span<const ChannelInfo* const> channels) {
  AnswerJson list = AnswerJson::array();
  for (const ChannelInfo* channel : channels) {
    list.push_back({{"id", channel->id},
                    {"topic", channel->topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel->schema_name},
                    {"schema", channel->schema},
                    {"schemaEncoding", "ros2msg"}});
  }
  return DumpJson({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string UnadvertiseText(std::span<const std::uint32_t> channels) {
  AnswerJson list = AnswerJson::array();
  for (const std::uint32_t channel : channels) list.push_back(channel);
  return DumpJson({{"op", "unadvertise"}, {"channelIds", std::move(list)}});
}

std::string StatusText(StatusLevel level, const std::string& message) {
  return DumpJson({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string MessageHead(std::uint32_t subscription, std::uint64_t stamp_ns) {
  std::string head(1, kDataOperation);
  AppendLittleEndian(head, subscription);
  AppendLittleEndian(head, stamp_ns);
  return head;
}

std::string TimeBytes(std::uint64_t now_ns) {
  std::string bytes(1, kTimeOperation);
  AppendLittleEndian(bytes, now_ns);
  return bytes;
}

}  // namespace qwsm::view
