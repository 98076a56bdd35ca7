// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "service/dds/entities/publications.hpp"

namespace qwsm::dds {

/// By what right a service answers a robot. The smaller claim wins: a service that was told to by
/// name goes before those that found the robot, and of these the first one wins.
struct Claim {
  std::uint64_t since_ns = 0;  ///< When the robot was found, since 1970; 0: it was told by name.
  Guid service{};              ///< The service's participant.

  std::strong_ordering operator<=>(const Claim&) const = default;
};

/// Which robots other services answer, as seen from their writers of match reports: a robot that
/// nobody answers any more may be answered by whoever finds it.
class OtherServices {
 public:
  /// Watches the writers of match reports.
  /// @param report_topic last part of their topic.
  /// @param report_type their DDS type.
  OtherServices(const Participant& participant,
                std::string_view report_topic,
                std::string report_type);

  /// Notes which services have come and gone since the last call. @returns whether any may have.
  bool Update();
  /// Whether another service answers the robot.
  bool Answer(std::string_view robot) const;
  /// Whether another service has a better claim on the robot.
  bool HaveBetterClaim(std::string_view robot, const Claim& claim) const;
  Entity::Handle handle() const { return publications_.handle(); }

 private:
  struct Answerer {
    std::string robot;
    Claim claim;
  };

  void Note(const Publication& publication);

  Guid own_;
  std::string report_topic_;
  std::string report_type_;
  Publications publications_;
  std::map<Guid, Answerer> answerers_;  // Services that answer, by writer.
};

/// A claim as text, which the user data of the writer of match reports carries.
std::string ToUserData(const Claim& claim);

}  // namespace qwsm::dds
