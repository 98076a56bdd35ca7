// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// What the service says, in version 1 of the Foxglove WebSocket protocol.
namespace qwsm::view {

/// Names of the protocol, of which a client offers one.
inline constexpr std::string_view kProtocolNames[] = {"foxglove.websocket.v1", "foxglove.sdk.v1"};

/// A topic that clients can subscribe to.
struct ChannelInfo {
  std::uint32_t id = 0;
  std::string topic;
  std::string schema_name;  ///< The type of its messages, such as `sensor_msgs/msg/LaserScan`.
  std::string schema;       ///< Its definition, with those of all types in it.
};

enum class StatusLevel { kInfo, kWarning, kError };

/// The first message: who this is, and what can be asked of it.
/// @param session changes with each start of the service.
std::string ServerInfoText(const std::string& name, const std::string& session);
std::string AdvertiseText(std::span<const ChannelInfo* const> channels);
std::string UnadvertiseText(std::span<const std::uint32_t> channels);
std::string StatusText(StatusLevel level, const std::string& message);

/// What stands before the bytes of a sample.
std::string MessageHead(std::uint32_t subscription, std::uint64_t stamp_ns);
/// The time of the service, since 1970.
std::string TimeBytes(std::uint64_t now_ns);

}  // namespace qwsm::view
