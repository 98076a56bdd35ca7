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

/// By what right a service answers a robot. The smaller one wins: a service that was told to by
/// name before those that found the robot, and of these the first.
struct Claim {
  std::uint64_t since_ns = 0;  ///< When it was found, since 1970; 0: told by name.
  Guid service{};              ///< Its participant.

  bool is_by_name() const { return since_ns == 0; }
  std::strong_ordering operator<=>(const Claim&) const = default;
};

/// Which robots other services answer, as seen from their writers of match reports: a robot that
/// nobody answers any more may be answered by whoever finds it.
class OtherServices {
 public:
  /// @param report_topic last part of their topic. @param report_type their DDS type.
  OtherServices(const Participant& participant,
                std::string_view report_topic,
                std::string report_type);

  /// Notes who has come and gone since the last call.
  void Update();
  /// Whether any of them answers the robot.
  bool Answer(std::string_view robot) const;
  /// Whether one of them has a better claim on the robot.
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
  std::map<Guid, Answerer> answerers_;  // By writer.
};

/// How a claim is told: in the user data of the writer of match reports.
std::string ToUserData(const Claim& claim);

}  // namespace qwsm::dds
