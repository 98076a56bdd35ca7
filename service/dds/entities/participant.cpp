// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/entities/participant.hpp"

#include <dds/dds.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace qwsm::dds {
namespace {

constexpr int kLastDomain = 230;  // Ports of higher ones do not exist.

std::uint32_t DomainOf(const NetworkOptions& options) {
  if (options.domain >= 0) return static_cast<std::uint32_t>(options.domain);
  const char* text = std::getenv("ROS_DOMAIN_ID");
  if (text == nullptr || *text == '\0') return 0;
  char* end = nullptr;
  const long domain = std::strtol(text, &end, 10);
  if (*end != '\0' || domain < 0 || domain > kLastDomain) {
    throw DdsError(
        fmt::format("ROS_DOMAIN_ID: must be a number from 0 to {}, got '{}'", kLastDomain, text));
  }
  return static_cast<std::uint32_t>(domain);
}

std::string EscapeXml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&' || c == '"' || c == ',') {
      throw DdsError(fmt::format("network: '{}' must not contain {}", text, c));
    }
    escaped += c;
  }
  return escaped;
}

// Loopback has no multicast by default: peers are named, and may be many on one host.
constexpr std::string_view kUnicastOnThisHost =
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto"
    "</ParticipantIndex><MaxAutoParticipantIndex>100</MaxAutoParticipantIndex>"
    "<Peers><Peer Address=\"localhost\"/></Peers>";

// A map of 4 MB comes in bursts; `min` stays at the system's default, for asking more may fail.
constexpr std::string_view kDefaults =
    "<CycloneDDS><Domain id=\"any\"><Internal>"
    "<SocketReceiveBufferSize min=\"default\" max=\"4MB\"/>"
    "</Internal></Domain></CycloneDDS>";

// Who was cut off is found again when one says that it is there, by default every 8 s. On loopback
// nobody is cut off, and it is said to each that might be there.
//
// A thread that receives multicast alone is woken for its end by multicast, which never comes where
// the interface has been taken down: one thread receives all.
constexpr std::string_view kDefaultsOfNetworks =
    "<CycloneDDS><Domain id=\"any\"><Discovery><SPDPInterval>2s</SPDPInterval></Discovery>"
    "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal>"
    "</Domain></CycloneDDS>";

/// What the options say, in Cyclone's language.
std::string ToXml(const NetworkOptions& options) {
  std::string xml = "<CycloneDDS><Domain id=\"any\"><General>";
  if (!options.interface.empty()) {
    xml += fmt::format("<Interfaces><NetworkInterface name=\"{}\"/></Interfaces>",
                       EscapeXml(options.interface));
  }
  xml += options.interface == "lo" ? kUnicastOnThisHost : "</General><Discovery>";
  if (!options.tag.empty()) xml += fmt::format("<Tag>{}</Tag>", EscapeXml(options.tag));
  return xml + "</Discovery></Domain></CycloneDDS>";
}

/// Later parts of a configuration win over earlier ones.
std::string ConfigurationOf(const NetworkOptions& options) {
  std::vector<std::string> parts{std::string(kDefaults)};
  if (options.interface != "lo") parts.emplace_back(kDefaultsOfNetworks);
  const char* environment = std::getenv("CYCLONEDDS_URI");
  if (environment != nullptr && *environment != '\0') parts.emplace_back(environment);
  parts.push_back(ToXml(options));
  return fmt::format("{}", fmt::join(parts, ","));
}

/// What decides on a network that cannot be used, to be looked at.
std::string SettingsOf(const NetworkOptions& options) {
  const char* environment = std::getenv("CYCLONEDDS_URI");
  std::string settings = options.interface.empty()
                             ? "network.interface"
                             : fmt::format("network.interface, which is '{}'", options.interface);
  if (environment != nullptr && *environment != '\0') settings += ", and CYCLONEDDS_URI";
  return settings;
}

Entity CreateParticipant(std::uint32_t domain, const NetworkOptions& options) {
  const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
  constexpr std::string_view kEnclave = "enclave=/;";  // As every ROS 2 participant says.
  dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
  return {dds_create_participant(domain, qos.get(), nullptr),
          fmt::format("domain {} cannot be joined; check {}", domain, SettingsOf(options))};
}

}  // namespace

Participant::Participant(const NetworkOptions& options) {
  const std::uint32_t domain = DomainOf(options);
  domain_ =
      Entity(dds_create_domain(domain, ConfigurationOf(options).c_str()),
             fmt::format("domain {} cannot be configured; check {}", domain, SettingsOf(options)));
  participant_ = CreateParticipant(domain, options);
}

Guid Participant::guid() const { return GuidOf(handle()); }

Guid GuidOf(Entity::Handle entity) {
  dds_guid_t raw{};
  dds_get_guid(entity, &raw);
  Guid guid{};
  std::ranges::copy(raw.v, guid.begin());
  return guid;
}

}  // namespace qwsm::dds
