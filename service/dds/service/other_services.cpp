// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/other_services.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {
namespace {

constexpr std::string_view kKey = "claim=";

/// A service that says nothing of a claim does not look for robots: it was told to.
std::uint64_t SinceOf(std::string_view user_data) {
  const std::size_t at = user_data.find(kKey);
  std::uint64_t since_ns = 0;
  if (at != std::string_view::npos) {
    const std::string_view number = user_data.substr(at + kKey.size());
    std::from_chars(number.data(), number.data() + number.size(), since_ns);
  }
  return since_ns;
}

}  // namespace

std::string ToUserData(const Claim& claim) {
  return std::string(kKey) + std::to_string(claim.since_ns) + ";";
}

OtherServices::OtherServices(const Participant& participant,
                             std::string_view report_topic,
                             std::string report_type)
    : own_(participant.guid()),
      report_topic_(report_topic),
      report_type_(std::move(report_type)),
      publications_(participant) {}

bool OtherServices::Update() {
  return publications_.TakeAll([this](const Publication& publication) { Note(publication); }) > 0;
}

void OtherServices::Note(const Publication& publication) {
  if (!publication.is_alive) {
    answerers_.erase(publication.writer);
    return;
  }
  if (publication.participant == own_ || publication.type != report_type_) return;
  const std::optional<std::string> robot = RobotNames::RobotOf(publication.topic, report_topic_);
  if (!robot) return;
  answerers_[publication.writer] = {
      .robot = *robot,
      .claim = {.since_ns = SinceOf(publication.user_data), .service = publication.participant}};
}

bool OtherServices::Answer(std::string_view robot) const {
  return std::ranges::any_of(answerers_,
                             [&](const auto& known) { return known.second.robot == robot; });
}

bool OtherServices::HaveBetterClaim(std::string_view robot, const Claim& claim) const {
  return std::ranges::any_of(answerers_, [&](const auto& known) {
    return known.second.robot == robot && known.second.claim < claim;
  });
}

}  // namespace qwsm::dds
